// Wrong calls, refusals, interruption: exit codes and messages.
#include <signal.h>

#include <chrono>
#include <sstream>
#include <thread>

#include "io/container/file_table.h"
#include "tests/cli/program.h"

namespace folprom::cli_test {
namespace {

class Usage : public CliTest {};

TEST_F(Usage, HelpShowsExamplesBeforeOptions) {
  for (const char* verb :
       {"encode", "decode", "info", "verify", "compare", "rd", "batch", "render", "synth"}) {
    const Outcome outcome = Run({verb, "--help"});
    EXPECT_EQ(outcome.exit_code, 0);
    const size_t example = outcome.out.find(std::string("  folprom ") + verb + " ");
    ASSERT_NE(example, std::string::npos) << outcome.out;
    EXPECT_LT(example, outcome.out.find("Options:"));
  }
  EXPECT_EQ(Run({"--help"}).exit_code, 0);
}

TEST_F(Usage, VersionTellsFileFormatAndBuild) {
  const Outcome outcome = Run({"--version"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_TRUE(outcome.out.starts_with("folprom ")) << outcome.out;
  const std::string format = "\nfile format: version " + std::to_string(io::kFormatVersion) + ",";
  EXPECT_NE(outcome.out.find(format), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("\nbuild: "), std::string::npos) << outcome.out;
}

TEST_F(Usage, RejectsMissingAndUnknownVerbsAndOptions) {
  ExpectError({}, 2, "no verb given");
  ExpectError({"compress"}, 2, "compress");
  ExpectError({"info", "a.folp", "--bogus"}, 2, "--bogus");
}

TEST_F(Usage, RejectsMissingArguments) {
  ExpectError({"encode"}, 2, "SCAN");
  ExpectError({"encode", "a.ply"}, 2, "-o");
  ExpectError({"decode", "a.folp"}, 2, "--output");
  ExpectError({"info"}, 2, "F.folp");
  ExpectError({"verify"}, 2, "F.folp");
  ExpectError({"synth", "-o", Path("s.ply")}, 2, "--vertices");
}

TEST_F(Usage, RejectsBoundsThatExcludeEachOther) {
  ExpectError({"encode", "a.ply", "-o", "a.folp", "--bits", "12", "--tolerance", "1"}, 2,
              "--tolerance");
  ExpectError({"encode", "a.ply", "-o", "a.folp", "--bits", "12", "--exact"}, 2, "--exact");
  ExpectError({"encode", "a.ply", "-o", "a.folp", "--tolerance", "1", "--exact"}, 2, "--exact");
  const std::vector<std::vector<std::string>> bounds = {
      {"--bpv", "2"}, {"--max-error", "1"}, {"--max-vertices", "10"}, {"--layers", "3"}};
  for (const auto& one : bounds) {
    for (const auto& other : bounds) {
      if (one == other) continue;
      ExpectError({"decode", "a.folp", "-o", Path("o.ply"), one[0], one[1], other[0], other[1]}, 2,
                  "excludes");
    }
  }
}

TEST_F(Usage, RejectsValuesOutOfRangeNamingTheOption) {
  const std::vector<std::string> encode = {"encode", "a.ply", "-o", Path("a.folp")};
  const auto with = [](std::vector<std::string> words, const std::string& option,
                       const std::string& value) {
    words.push_back(option);
    words.push_back(value);
    return words;
  };
  for (const char* value : {"0", "25", "-1", "x", "1.5"}) {
    ExpectError(with(encode, "--bits", value), 2, "--bits");
  }
  for (const char* value : {"0", "10", "-1", "x", "1.5", ""}) {
    ExpectError(with(encode, "--effort", value), 2, "--effort");
  }
  for (const char* value : {"0", "-1", "nan", "inf", "1mm", ""}) {
    ExpectError(with(encode, "--tolerance", value), 2, "--tolerance");
  }
  for (const char* value : {"1e38", "1e41", "1e300"}) {
    ExpectError(with(encode, "--tolerance", value), 2, "tolerance");
  }
  for (const char* value : {"12x", "-1", "", "1.5", "1e300", "MiB"}) {
    ExpectError(with(encode, "-M", value), 2, "--memory");
  }
  ExpectError(with(encode, "-M", "0"), 2, "memory");
  ExpectError({"synth", "--vertices", "4294967296", "-o", Path("s.ply")}, 2, "4294967295");
  ExpectError(with(encode, "--subtree-vertices", "0"), 2, "--subtree-vertices");
  ExpectError(with(encode, "--subtree-vertices", "5G"), 2, "subtree_vertices");
  ExpectError(with(encode, "-T", "-1"), 2, "--threads");
  ExpectError(with(encode, "--runner", "shuffled:x"), 2, "--runner");
  const std::vector<std::string> decode = {"decode", "a.folp", "-o", Path("o.ply")};
  ExpectError(with(decode, "--layers", "0"), 2, "--layers");
  ExpectError(with(decode, "--bpv", "0"), 2, "--bpv");
  for (const char* value : {"0,0,0,1,1", "0,0,0,1,1,1,1", "0,0,0,-1,1,1", "a", "0,0,0,1,1,nan"}) {
    ExpectError(with(decode, "--region", value), 2, "--region");
  }
}

TEST_F(Usage, MissingInputIsAnInputError) {
  ExpectError({"encode", Path("none.ply"), "-o", Path("o.folp")}, 3, "none.ply");
  ExpectError({"decode", Path("none.folp"), "-o", Path("o.ply")}, 3, "none.folp");
  ExpectError({"info", Path("none.folp"), "--json"}, 3, "none.folp");
  ExpectError({"verify", Path("none.folp")}, 3, "none.folp");
  EXPECT_TRUE(Files().empty());
}

TEST_F(Usage, RefusesToOverwriteWithoutForce) {
  ASSERT_EQ(Run({"synth", "--vertices", "100", "-o", Path("s.ply"), "-q"}).exit_code, 0);
  WriteText(Path("old.ply"), "old");
  ExpectError({"synth", "--vertices", "100", "-o", Path("old.ply")}, 5, "-f");
  ExpectError({"encode", Path("s.ply"), "-o", Path("old.ply")}, 5, "-f");
  ExpectError({"decode", Path("s.ply"), "-o", Path("old.ply")}, 5, "-f");
  EXPECT_EQ(FileText(Path("old.ply")), "old");
  EXPECT_EQ(Run({"synth", "--vertices", "100", "-o", Path("old.ply"), "-q", "-f"}).exit_code, 0);
  EXPECT_EQ(FileText(Path("old.ply")), FileText(Path("s.ply")));
}

TEST_F(Usage, NeverReplacesTheInput) {
  ASSERT_EQ(Run({"synth", "--vertices", "100", "-o", Path("s.ply"), "-q"}).exit_code, 0);
  const std::string before = FileText(Path("s.ply"));
  ExpectError({"encode", Path("s.ply"), "-o", Path("../files/s.ply"), "-f"}, 2, "is the input");
  EXPECT_EQ(FileText(Path("s.ply")), before);
}

TEST_F(Usage, OutputInMissingFolderIsAnOutputError) {
  ExpectError({"synth", "--vertices", "100", "-o", Path("none/s.ply")}, 5, "none/s.ply");
}

TEST_F(Usage, InterruptedRunLeavesNothingBehind) {
  struct Case {
    const char* stage;
    const char* vertices;
    int signal;
  };
  for (const Case& c :
       {Case{"count", "4G", SIGINT}, Case{"write", "20M", SIGTERM}, Case{"write", "20M", SIGHUP}}) {
    // Both stages last for seconds; the log line tells that one has begun.
    const pid_t process = Start({"synth", "--vertices", c.vertices, "-o", Path("s.ply"), "-v"});
    for (int i = 0; i < 6000 && ErrorsSoFar().find(c.stage) == std::string::npos; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    kill(process, c.signal);
    const Outcome outcome = Wait(process);
    EXPECT_EQ(outcome.exit_code, 130);
    EXPECT_NE(outcome.err.find("folprom: interrupted\n"), std::string::npos) << outcome.err;
    EXPECT_TRUE(Files().empty()) << c.stage;
  }
}

TEST_F(Usage, FileThatMayNotGrowIsAnOutputErrorAndLeavesNothing) {
  ASSERT_EQ(Run({"synth", "--vertices", "3000", "-o", Path("s.ply"), "-q"}).exit_code, 0);
  ASSERT_EQ(Run({"encode", Path("s.ply"), "-o", Path("s.folp"), "-q"}).exit_code, 0);
  std::filesystem::create_directory(Path("tmp"));
  const std::vector<std::string> before = Files();
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"synth", "--vertices", "3000", "-o", Path("o.ply")},
        {"synth", "--vertices", "3000", "-o", Path("o.stl")},
        {"encode", Path("s.ply"), "-o", Path("o"), "--tmp", Path("tmp")},
        {"decode", Path("s.folp"), "-o", Path("o.ply"), "--tmp", Path("tmp")},
        {"decode", Path("s.folp"), "-o", Path("o.obj"), "--tmp", Path("tmp")},
        {"decode", Path("s.folp"), "-o", Path("o.stl"), "--tmp", Path("tmp")},
        {"decode", Path("s.folp"), "-o", Path("o.off"), "--tmp", Path("tmp")}}) {
    const Outcome outcome = Wait(Start(arguments, 4000));
    EXPECT_EQ(outcome.exit_code, 5) << arguments[0] << ": " << outcome.err;
    EXPECT_NE(outcome.err.find("cannot write"), std::string::npos) << outcome.err;
    EXPECT_EQ(Files(), before) << arguments[0];
    EXPECT_TRUE(std::filesystem::is_empty(Path("tmp"))) << arguments[0];
  }
}

TEST_F(Usage, EveryWorkingVerbTellsItsProgressAsJsonLines) {
  const std::vector<std::vector<std::string>> calls = {
      {"synth", "--vertices", "2000", "-o", Path("s.ply")},
      {"encode", Path("s.ply"), "-o", Path("s.folp")},
      {"decode", Path("s.folp"), "-o", Path("d.ply")},
      {"verify", Path("s.folp")},
      {"compare", Path("s.ply"), Path("d.ply"), "--samples", "1k"},
      {"rd", Path("s.ply"), "--bpv", "4", "--samples", "1k"}};
  for (std::vector<std::string> arguments : calls) {
    arguments.insert(arguments.end(), {"-q", "--progress", "json"});
    const Outcome outcome = Run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    std::istringstream lines(outcome.err);
    std::string line;
    size_t count = 0;
    for (; std::getline(lines, line); ++count) {
      const auto reading = nlohmann::json::parse(line);
      EXPECT_NE(reading.at("stage"), "") << arguments[0];
      EXPECT_LE(reading.at("done"), reading.at("total")) << arguments[0];
      EXPECT_GT(reading.at("memory_bytes"), 0);
    }
    EXPECT_GT(count, 0) << arguments[0];
  }
  ExpectError({"synth", "--vertices", "9", "-o", Path("o"), "--progress", "xml"}, 2, "--progress");
}

TEST_F(Usage, QuietPrintsNothing) {
  const Outcome outcome = Run({"synth", "--vertices", "1000", "-o", Path("s.ply"), "-q"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "");
}

}  // namespace
}  // namespace folprom::cli_test
