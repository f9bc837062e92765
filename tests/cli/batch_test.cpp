// Batches that run: outputs, reports, and what a second run does.
#include <algorithm>
#include <sstream>

#include "tests/cli/batch_fixture.h"

namespace folprom::cli_test {
namespace {

class Batch : public BatchTest {
 protected:
  void ExpectAll(const std::string& status) const {
    for (const auto& [name, found] : Statuses()) EXPECT_EQ(found, status) << name;
  }
};

constexpr const char* kJob = R"([[job]]
input = "scans/*.ply"
output = "out"
operations = ["encode", "verify", "decode"]
lods = [{ max_vertices = 500 }, {}]
)";

TEST_F(Batch, DoesWhatTheVerbsDo) {
  MakeScan("scans/a.ply", 3000, 1);
  MakeScan("scans/b.ply", 4000, 2);
  WriteJob(std::string(kJob) + "effort = 3\nbits = 11\n");
  const Outcome outcome = RunBatch();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("2 of 2 scans done"), std::string::npos) << outcome.out;
  for (const std::string name : {"a", "b"}) {
    const std::string folp = Path(name + ".folp");
    ASSERT_EQ(Run({"encode", Path("scans/" + name + ".ply"), "-o", folp, "--effort", "3", "--bits",
                   "11", "-q"})
                  .exit_code,
              0);
    EXPECT_EQ(FileText(Path("out/" + name + ".folp")), FileText(folp));
    ASSERT_EQ(
        Run({"decode", folp, "-o", Path("lod.ply"), "--max-vertices", "500", "-q", "-f"}).exit_code,
        0);
    EXPECT_EQ(FileText(Path("out/" + name + ".vertices500.ply")), FileText(Path("lod.ply")));
    ASSERT_EQ(Run({"decode", folp, "-o", Path("whole.ply"), "-q", "-f"}).exit_code, 0);
    EXPECT_EQ(FileText(Path("out/" + name + ".ply")), FileText(Path("whole.ply")));
  }
}

TEST_F(Batch, ReportHoldsEveryOperation) {
  MakeScan("scans/a.ply", 3000, 1);
  WriteJob(R"([defaults]
operations = ["encode", "verify", "decode", "rd"]
[[job]]
name = "all"
input = ["scans/*.ply"]
output = "out"
lods = [{ bpv = 4 }]
rates = [2, 8]
samples = "10k"
)");
  const Outcome outcome = RunBatch({"--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json report = outcome.json();
  EXPECT_EQ(report, Report());
  const auto& results = report.at("results");
  ASSERT_EQ(results.size(), 4);
  for (const auto& result : results) {
    EXPECT_EQ(result.at("status"), "done");
    EXPECT_EQ(result.at("job"), "all");
    EXPECT_EQ(result.at("scan"), "a.ply");
    EXPECT_EQ(result.at("input"), Path("scans/a.ply"));
    EXPECT_GT(result.at("seconds").get<double>(), 0);
    EXPECT_GT(result.at("peak_memory_bytes").get<uint64_t>(), 1000000);
    EXPECT_EQ(result.at("exit_code"), 0);
  }
  const auto& encode = results[0];
  const auto bytes = std::filesystem::file_size(Path("out/a.folp"));
  EXPECT_EQ(encode.at("output_bytes"), bytes);
  EXPECT_EQ(encode.at("input_bytes"), std::filesystem::file_size(Path("scans/a.ply")));
  EXPECT_DOUBLE_EQ(encode.at("bits_per_vertex"), 8.0 * static_cast<double>(bytes) / 3000);
  EXPECT_EQ(results[1].at("verified"), true);
  EXPECT_EQ(results[2].at("lod"), "bpv 4");
  EXPECT_LT(results[2].at("vertices"), 3000);
  const auto& points = results[3].at("points");
  ASSERT_EQ(points.size(), 2);
  EXPECT_LT(points[1].at("mean"), points[0].at("mean"));
  for (const char* suffix : {".json", ".csv", ".svg"}) {
    EXPECT_TRUE(std::filesystem::exists(Path("out/a.rd" + std::string(suffix)))) << suffix;
  }
  // The lines are the same results, in the order in which they ended.
  std::istringstream lines(FileText(Path("job.report/report.jsonl")));
  size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const auto result = nlohmann::json::parse(line);
    EXPECT_NE(std::find(results.begin(), results.end(), result), results.end()) << line;
  }
  EXPECT_EQ(count, results.size());
}

TEST_F(Batch, SecondRunDoesNothing) {
  MakeScan("scans/a.ply", 2000, 1);
  MakeScan("scans/b.ply", 2000, 2);
  WriteJob(kJob);
  ASSERT_EQ(RunBatch().exit_code, 0);
  const auto before = Contents("out");
  const nlohmann::json first = Report();
  ASSERT_EQ(RunBatch({"-q"}).exit_code, 0);
  ExpectAll("up_to_date");
  EXPECT_EQ(Contents("out"), before);
  // The figures are still those of the first run.
  const nlohmann::json second = Report();
  EXPECT_EQ(second.at("scans_done"), 2);
  EXPECT_EQ(second.at("results")[0].at("output_bytes"), first.at("results")[0].at("output_bytes"));
  EXPECT_EQ(second.at("results")[1].at("verified"), true);
}

TEST_F(Batch, ContentDecidesNotTheClock) {
  MakeScan("scans/a.ply", 2000, 1);
  MakeScan("scans/b.ply", 2000, 2);
  WriteJob(kJob);
  ASSERT_EQ(RunBatch().exit_code, 0);
  // The same content written again, and older than the output.
  const std::string text = FileText(Path("scans/a.ply"));
  std::filesystem::remove(Path("scans/a.ply"));
  WriteText(Path("scans/a.ply"), text);
  ASSERT_EQ(RunBatch().exit_code, 0);
  ExpectAll("up_to_date");
  // Other content of the same size, with the old time of change.
  const auto time = std::filesystem::last_write_time(Path("scans/a.ply"));
  std::string other = text;
  other[other.size() - 60000] ^= 1;
  WriteText(Path("scans/a.ply"), other);
  std::filesystem::last_write_time(Path("scans/a.ply"), time);
  RunBatch();
  const auto statuses = Statuses();
  EXPECT_EQ(statuses.at("encode a.ply"), "done");
  EXPECT_EQ(statuses.at("verify a.ply"), "done");
  EXPECT_EQ(statuses.at("encode b.ply"), "up_to_date");
  EXPECT_EQ(statuses.at("decode b.ply whole"), "up_to_date");
}

TEST_F(Batch, SettingsDecideAndOnlyThoseThatMatter) {
  MakeScan("scans/a.ply", 2000, 1);
  WriteJob(kJob);
  ASSERT_EQ(RunBatch().exit_code, 0);
  WriteJob(std::string("[defaults]\nmemory = \"1GiB\"\nthreads = 1\n") + kJob);
  ASSERT_EQ(RunBatch().exit_code, 0);
  ExpectAll("up_to_date");
  WriteJob(std::string(kJob) + "bits = 10\n");
  ASSERT_EQ(RunBatch().exit_code, 0);
  ExpectAll("done");
}

TEST_F(Batch, MissingAndDamagedOutputsAreMadeAgain) {
  MakeScan("scans/a.ply", 2000, 1);
  WriteJob(kJob);
  ASSERT_EQ(RunBatch().exit_code, 0);
  const auto before = Contents("out");
  std::filesystem::remove(Path("out/a.vertices500.ply"));
  std::string damaged = FileText(Path("out/a.ply"));
  damaged[damaged.size() / 2] ^= 4;
  WriteText(Path("out/a.ply"), damaged);
  ASSERT_EQ(RunBatch().exit_code, 0);
  EXPECT_EQ(Statuses(),
            (std::map<std::string, std::string>{{"encode a.ply", "up_to_date"},
                                                {"verify a.ply", "up_to_date"},
                                                {"decode a.ply max_vertices 500", "done"},
                                                {"decode a.ply whole", "done"}}));
  EXPECT_EQ(Contents("out"), before);
}

TEST_F(Batch, FailedScanStopsNoOther) {
  MakeScan("scans/a.ply", 2000, 1);
  MakeScan("scans/c.ply", 2000, 3);
  WriteText(Path("scans/b.ply"), "ply\nformat ascii 1.0\nelement vertex 3\n");
  WriteJob(kJob);
  const Outcome outcome = RunBatch({"--json"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("b.ply"), std::string::npos) << outcome.err;
  const nlohmann::json report = outcome.json();
  EXPECT_EQ(report.at("scans_done"), 2);
  EXPECT_EQ(report.at("scans_failed"), 1);
  EXPECT_EQ(report.at("exit_code"), 3);
  const auto statuses = Statuses();
  EXPECT_EQ(statuses.at("encode b.ply"), "failed");
  EXPECT_EQ(statuses.at("verify b.ply"), "not_run");
  EXPECT_EQ(statuses.at("decode c.ply whole"), "done");
  for (const auto& result : report.at("results")) {
    if (result.at("status") != "failed") continue;
    EXPECT_NE(result.at("error").get<std::string>().find("b.ply"), std::string::npos);
  }
  EXPECT_FALSE(std::filesystem::exists(Path("out/b.folp")));
  // Mended, only it is done.
  MakeScan("scans/b.ply", 2000, 2);
  ASSERT_EQ(RunBatch().exit_code, 0);
  EXPECT_EQ(Statuses().at("encode b.ply"), "done");
  EXPECT_EQ(Statuses().at("encode a.ply"), "up_to_date");
}

TEST_F(Batch, StopsAfterAFailureWhereAsked) {
  // The largest begins first.
  WriteText(Path("bad.ply"), "ply\n" + std::string(1000000, 'x'));
  MakeScan("scans/a.ply", 2000, 1);
  WriteJob(R"([defaults]
threads = 1
output = "out"
on_error = "stop"
[[job]]
input = "bad.ply"
[[job]]
input = "scans/a.ply"
)");
  EXPECT_EQ(RunBatch().exit_code, 3);
  EXPECT_EQ(Statuses().at("encode a.ply"), "not_run");
}

TEST_F(Batch, OutputsDoNotDependOnTheSchedule) {
  for (int i = 0; i < 4; ++i) MakeScan("scans/s" + std::to_string(i) + ".ply", 1500 + 900 * i, i);
  const std::string job = "[[job]]\ninput = \"scans/*\"\nsubtree_vertices = 500\n";
  WriteJob(job + "output = \"one\"\n");
  ASSERT_EQ(RunBatch({"-T", "1", "-M", "80MiB"}).exit_code, 0);
  const nlohmann::json report = Report();
  for (const auto& result : report.at("results")) {
    EXPECT_EQ(result.at("threads"), 1);
    EXPECT_LE(result.at("memory_bytes"), 80 << 20);
  }
  WriteJob(job + "output = \"many\"\n");
  ASSERT_EQ(RunBatch({"-T", "8"}).exit_code, 0);
  EXPECT_EQ(Report().at("results")[3].at("threads"), 8);
  EXPECT_EQ(Contents("one"), Contents("many"));
}

TEST_F(Batch, DryRunTellsWhyAndWritesNothing) {
  MakeScan("scans/a.ply", 2000, 1);
  WriteJob(kJob);
  const std::vector<std::string> before = Files();
  const Outcome first = RunBatch({"--dry-run"});
  EXPECT_EQ(first.exit_code, 0);
  EXPECT_EQ(Files(), before);
  EXPECT_NE(first.out.find("run: encode " + Path("scans/a.ply") + " -> " + Path("out/a.folp") +
                           ": not made yet"),
            std::string::npos)
      << first.out;
  ASSERT_EQ(RunBatch().exit_code, 0);
  std::filesystem::remove(Path("out/a.ply"));
  const Outcome second = RunBatch({"--dry-run"});
  EXPECT_NE(second.out.find("skip: encode"), std::string::npos) << second.out;
  EXPECT_NE(second.out.find("a.ply: output is missing"), std::string::npos) << second.out;
  EXPECT_NE(second.out.find("1 operations to run, 3 up to date"), std::string::npos) << second.out;
  const Outcome json = RunBatch({"--dry-run", "--json"});
  EXPECT_EQ(json.json().at("dry_run"), true);
  EXPECT_EQ(json.json().at("results").size(), 4);
  EXPECT_FALSE(std::filesystem::exists(Path("out/a.ply")));
}

TEST_F(Batch, StartsFromEncodedFiles) {
  MakeScan("a.ply", 2000, 1);
  ASSERT_EQ(Run({"encode", Path("a.ply"), "-o", Path("a.folp"), "-q"}).exit_code, 0);
  WriteJob(R"([[job]]
input = "*.folp"
output = "out"
operations = ["decode", "verify"]
lods = [{ layers = 1, name = "first" }]
)");
  const Outcome outcome = RunBatch();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(std::filesystem::exists(Path("out/a.first.ply")));
  EXPECT_EQ(Report().at("results")[0].at("operation"), "verify");
  EXPECT_EQ(Report().at("results")[0].at("verified"), true);
}

TEST_F(Batch, MirrorsFoldersByThePattern) {
  MakeScan("scans/x/a.ply", 500, 1);
  MakeScan("scans/y/z/a.ply", 500, 2);
  MakeScan("scans/a.ply", 500, 3);
  MakeScan("scans/old_a.ply", 500, 4);
  WriteJob(R"([[job]]
input = "scans/**/*.ply"
exclude = "**/old_*"
output = "out"
pattern = "{folder}/{stem}-{job}"
)");
  ASSERT_EQ(RunBatch().exit_code, 0);
  std::vector<std::string> names;
  for (const auto& [name, content] : Contents("out")) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"a-job1.folp", "x/a-job1.folp", "y/z/a-job1.folp"}));
}

TEST_F(Batch, NearerSettingsWin) {
  MakeScan("a.ply", 800, 1);
  WriteText(Path("c.toml"), "[encode]\ntolerance = 0.5\n[codec]\neffort = 1\nmixers = 2\n");
  WriteJob(R"([defaults]
config = "c.toml"
input_is_missing = 1
)");
  EXPECT_EQ(RunBatch().exit_code, 2);
  WriteJob(R"([defaults]
config = "c.toml"
least_layer = 7
[[job]]
input = "a.ply"
output = "out"
bits = 9
)");
  ASSERT_EQ(RunBatch().exit_code, 0);
  EXPECT_EQ(Report().at("results")[0].at("settings"), "9 bits, effort 1");
  ASSERT_EQ(Run({"encode", Path("a.ply"), "-o", Path("a.folp"), "-q", "--config", Path("c.toml"),
                 "--bits", "9"})
                .exit_code,
            0);
  const auto codec = [&](const std::string& file) {
    return Run({"info", Path(file), "--json"}).json().at("codec");
  };
  EXPECT_EQ(codec("out/a.folp").at("least_layer"), 7);
  EXPECT_EQ(codec("out/a.folp").at("mixers"), 2);
  EXPECT_EQ(codec("out/a.folp").at("effort"), codec("a.folp").at("effort"));
}

TEST_F(Batch, ProgressAsJsonLines) {
  MakeScan("a.ply", 10000, 1);
  WriteJob("[[job]]\ninput = \"a.ply\"\noutput = \"out\"\neffort = 9\n");
  const Outcome outcome = RunBatch({"--progress", "json", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.json().at("scans_done"), 1);
  std::istringstream lines(outcome.err);
  size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const auto reading = nlohmann::json::parse(line);
    EXPECT_EQ(reading.at("scans"), 1);
    EXPECT_GE(reading.at("fraction"), 0);
    EXPECT_LE(reading.at("fraction"), 1);
    EXPECT_GT(reading.at("memory_bytes"), 0);
    for (const auto& running : reading.at("running")) EXPECT_EQ(running.at("scan"), "a.ply");
  }
  EXPECT_GT(count, 0);
}

TEST_F(Batch, LimitOfTheOutputIsAnErrorOfItsScan) {
  MakeScan("a.ply", 3000, 1);
  WriteJob("[[job]]\ninput = \"a.ply\"\noutput = \"out\"\n");
  // Room for the state file and the report, not for the scan.
  const Outcome outcome = Wait(Start({"batch", Path("job.toml"), "--no-pictures"}, 4000));
  EXPECT_EQ(outcome.exit_code, 5) << outcome.err;
  EXPECT_NE(outcome.err.find("cannot write"), std::string::npos) << outcome.err;
  EXPECT_EQ(Contents("out").size(), 0);
}

TEST_F(Batch, ForeignOutputsAreNotReplacedUnlessAsked) {
  MakeScan("a.ply", 500, 1);
  std::filesystem::create_directory(Path("out"));
  WriteText(Path("out/a.folp"), "mine");
  const std::string job = "[[job]]\ninput = \"a.ply\"\noutput = \"out\"\n";
  WriteJob(job);
  ExpectError({"batch", Path("job.toml")}, 5, "was not made by a batch");
  EXPECT_EQ(FileText(Path("out/a.folp")), "mine");
  WriteJob(job + "existing = \"overwrite\"\n");
  EXPECT_EQ(RunBatch().exit_code, 0);
  EXPECT_NE(FileText(Path("out/a.folp")), "mine");
  // From now on it is the batch's own.
  WriteJob(job);
  EXPECT_EQ(RunBatch().exit_code, 0);
  EXPECT_EQ(Statuses().at("encode a.ply"), "up_to_date");
  WriteJob(job + "existing = \"fail\"\n");
  ExpectError({"batch", Path("job.toml")}, 5, "exists already");
}

}  // namespace
}  // namespace folprom::cli_test
