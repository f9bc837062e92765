// Config files: every key known, errors that help, precedence, and files that match the program.
#define TOML_HEADER_ONLY 1
#include <toml++/toml.h>

#include <algorithm>
#include <map>
#include <set>

#include "tests/cli/program.h"

namespace folprom::cli_test {
namespace {

const std::string kConfigs = FOLPROM_SOURCE_DIR "/configs/";
constexpr const char* kFiles[] = {"default.toml", "archive.toml", "fast.toml", "paper.toml",
                                  "web.toml"};

class Config : public CliTest {
 protected:
  std::string Write(const std::string& text) const {
    WriteText(Path("c.toml"), text);
    return Path("c.toml");
  }
  Outcome Effective(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"encode", "--print-config"});
    return Run(arguments);
  }
  void ExpectRejected(const std::string& text, int line, const std::string& part) const {
    const std::string path = Write(text);
    ExpectError({"encode", "--print-config", "--config", path}, 2, part);
    ExpectError({"encode", "--print-config", "--config", path}, 2,
                path + ":" + std::to_string(line) + ": ");
  }
};

std::set<std::string> KeysOf(const toml::table& root) {
  std::set<std::string> keys;
  for (const auto& [table, node] : root) {
    for (const auto& [key, value] : *node.as_table()) {
      keys.insert(std::string(table.str()) + "." + std::string(key.str()));
    }
  }
  return keys;
}

// The file without its first comment, which the program does not print.
std::string FromFirstTable(const std::string& text) { return text.substr(text.find("\n[") + 1); }

TEST_F(Config, DefaultFileIsWhatTheProgramPrints) {
  const Outcome printed = Effective({});
  ASSERT_EQ(printed.exit_code, 0);
  EXPECT_EQ(FromFirstTable(FileText(kConfigs + "default.toml")), printed.out);
}

TEST_F(Config, EveryOtherFileIsInTheFormThatTheProgramPrints) {
  for (const char* name : {"archive.toml", "fast.toml", "paper.toml", "web.toml"}) {
    const Outcome printed = Effective({"--config", kConfigs + name});
    ASSERT_EQ(printed.exit_code, 0) << printed.err;
    EXPECT_EQ(FromFirstTable(FileText(kConfigs + name)), printed.out);
  }
}

TEST_F(Config, FilesDoWhatTheirNamesSay) {
  ASSERT_EQ(Run({"synth", "--vertices", "5000", "-o", Path("s.ply"), "-q"}).exit_code, 0);
  std::map<std::string, nlohmann::json> infos;
  for (const std::string name : {"default", "archive", "fast", "web"}) {
    const std::string folp = Path(name + ".folp");
    ASSERT_EQ(
        Run({"encode", Path("s.ply"), "-o", folp, "-q", "--config", kConfigs + name + ".toml"})
            .exit_code,
        0);
    EXPECT_EQ(Run({"verify", folp, "--against", Path("s.ply"), "-q"}).exit_code, 0) << name;
    infos[name] = Run({"info", folp, "--json"}).json();
  }
  EXPECT_FALSE(infos.at("archive").at("exact").is_null());
  EXPECT_EQ(infos.at("fast").at("codec").at("effort"), 1);
  EXPECT_GT(infos.at("fast").at("bytes"), infos.at("default").at("bytes"));
  const auto first_layer = [&](const std::string& name) {
    return infos.at(name).at("layers")[0].at("end_byte").get<uint64_t>();
  };
  EXPECT_LT(first_layer("web"), first_layer("default"));
}

TEST_F(Config, LatticeOffsetsAskForTheQuadricHierarchy) {
  const Outcome refused = Effective({"--config", Write("[codec]\nhierarchy = \"lloyd\"\n")});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("hierarchy = \"quadric\""), std::string::npos) << refused.err;
}

TEST_F(Config, ExactAsksForLatticeOffsets) {
  ExpectError({"encode", "--print-config", "--exact", "--config", kConfigs + "paper.toml"}, 2,
              "offsets = \"lattice\"");
  const Outcome refused =
      Effective({"--config", Write("[encode]\nexact = true\n[codec]\noffsets = \"cartesian\"\n")});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("exact needs offsets = \"lattice\""), std::string::npos)
      << refused.err;
}

TEST_F(Config, BitsOnTheCommandLineWinOverExactInTheFile) {
  const std::string config = Write("[encode]\nexact = true\n");
  const auto exact = [&](const std::vector<std::string>& flags) {
    std::vector<std::string> arguments = {"--config", config};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    return *toml::parse(Effective(arguments).out)["encode"]["exact"].value<bool>();
  };
  EXPECT_TRUE(exact({}));
  EXPECT_FALSE(exact({"--bits", "14"}));
  EXPECT_FALSE(exact({"--tolerance", "0.5"}));
}

TEST_F(Config, EveryKeyStandsInEveryFileAndNoOther) {
  const auto known = KeysOf(toml::parse(Effective({}).out));
  EXPECT_GT(known.size(), 20u);
  for (const char* name : kFiles) {
    EXPECT_EQ(KeysOf(toml::parse_file(kConfigs + name)), known) << name;
  }
  // That of batches has them flat, and those of the whole batch once more.
  const std::string example = FileText(kConfigs + "batch_example.toml");
  for (const std::string& key : known) {
    const std::string name = key.substr(key.find('.') + 1);
    EXPECT_NE(example.find("\n#" + name + " = "), std::string::npos) << name;
  }
}

TEST_F(Config, EveryKeyOfTheFilesHasItsComment) {
  for (const char* name : kFiles) {
    const std::string text = FileText(kConfigs + name);
    for (const std::string& full_name : KeysOf(toml::parse(text))) {
      const std::string key = full_name.substr(full_name.find('.') + 1);
      const size_t at = text.find("\n" + key + " = ");
      ASSERT_NE(at, std::string::npos) << key;
      const std::string comment = text.substr(text.rfind("\n\n", at), at - text.rfind("\n\n", at));
      EXPECT_GE(std::count(comment.begin(), comment.end(), '#'), 2) << key;
      EXPECT_NE(comment.find("default: "), std::string::npos) << key;
    }
  }
}

TEST_F(Config, PaperFileHoldsThePapersConstants) {
  const Outcome effective = Effective({"--config", kConfigs + "paper.toml"});
  ASSERT_EQ(effective.exit_code, 0) << effective.err;
  const toml::table root = toml::parse(effective.out);
  const auto& codec = *root["codec"].as_table();
  EXPECT_EQ(codec["children"].value<int>(), 4);
  EXPECT_EQ(codec["metric_a"].value<double>(), 1.0);
  EXPECT_EQ(codec["metric_b"].value<double>(), 8.0);
  EXPECT_EQ(codec["gaussian_ratio"].value<double>(), 3.0);
  EXPECT_EQ(codec["hierarchy"].value<std::string>(), "lloyd");
  EXPECT_EQ(codec["representative"].value<std::string>(), "curvature");
  EXPECT_EQ(codec["offsets"].value<std::string>(), "cylindrical");
  EXPECT_EQ(codec["fan_cuts"].value<bool>(), false);
  for (const char* key :
       {"subtree_normals", "normal_metric", "adaptive_quantisation", "predict_theta",
        "predict_height", "split_first", "pivot_order", "nearer_child"}) {
    EXPECT_EQ(codec[key].value<bool>(), true) << key;
  }
}

TEST_F(Config, PrintedSettingsReadBackTheSame) {
  const std::string config = Write(
      "[codec]\nchildren = 2\nmetric_b = 3\nlloyd_threshold = 0.1\npredict_theta = false\n"
      "representative = \"centre\"\n[encode]\nmemory = 1000000\n"
      "tmp = \"/a \\\"b\\\" \\\\ \u00e4\"\n");
  const Outcome first = Effective({"--config", config, "--tolerance", "1e-7", "-T", "3"});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const Outcome second = Effective({"--config", Write(first.out)});
  EXPECT_EQ(second.out, first.out);
  const toml::table root = toml::parse(first.out);
  EXPECT_EQ(root["codec"]["children"].value<int>(), 2);
  EXPECT_EQ(root["codec"]["metric_b"].value<double>(), 3.0);
  EXPECT_EQ(root["codec"]["predict_theta"].value<bool>(), false);
  EXPECT_EQ(root["codec"]["representative"].value<std::string>(), "centre");
  EXPECT_EQ(root["encode"]["memory"].value<std::string>(), "1000000");
  EXPECT_EQ(root["encode"]["tolerance"].value<double>(), 1e-7);
  EXPECT_EQ(root["encode"]["threads"].value<int>(), 3);
}

TEST_F(Config, FlagsWinOverTheFileAndTheFileOverDefaults) {
  const std::string config =
      Write("[encode]\ntolerance = 0.5\nmemory = \"1GiB\"\n[codec]\nsubtree_vertices = 1000\n");
  const toml::table from_file = toml::parse(Effective({"--config", config}).out);
  EXPECT_EQ(from_file["encode"]["tolerance"].value<double>(), 0.5);
  EXPECT_EQ(from_file["encode"]["memory"].value<std::string>(), "1GiB");
  const toml::table with_flags = toml::parse(
      Effective({"--config", config, "--bits", "16", "--subtree-vertices", "20k", "-M", "512MiB"})
          .out);
  EXPECT_EQ(with_flags["encode"]["bits"].value<int>(), 16);
  EXPECT_EQ(with_flags["encode"]["tolerance"].value<double>(), 0.0);
  EXPECT_EQ(with_flags["encode"]["memory"].value<std::string>(), "512MiB");
  EXPECT_EQ(with_flags["codec"]["subtree_vertices"].value<int>(), 20000);
}

TEST_F(Config, KeysWinOverTheEffortOfTheFileAndTheFlagOverBoth) {
  // Wherever it stands in the table.
  const std::string config = Write("[codec]\ndensity_step = 3\neffort = 1\n");
  const auto codec = [&](std::vector<std::string> flags) {
    flags.insert(flags.begin(), {"--config", config});
    return *toml::parse(Effective(flags).out)["codec"].as_table();
  };
  const toml::table from_file = codec({});
  EXPECT_EQ(from_file["effort"].value<int>(), 1);
  EXPECT_EQ(from_file["density_step"].value<int>(), 3);
  EXPECT_EQ(from_file["subtree_vertices"].value<int>(), 65536);
  EXPECT_EQ(from_file["models"].value<std::string>(), "light");
  EXPECT_EQ(from_file["rounds_per_step"].value<int>(), 1);
  const toml::table with_flag = codec({"--effort", "9"});
  EXPECT_EQ(with_flag["effort"].value<int>(), 9);
  EXPECT_EQ(with_flag["density_step"].value<int>(), 1);
  EXPECT_EQ(with_flag["mixers"].value<int>(), 3);
  EXPECT_EQ(with_flag["models"].value<std::string>(), "full");
  EXPECT_EQ(with_flag["subtree_vertices"].value<int>(), 1048576);
  const toml::table with_both = codec({"--effort", "9", "--subtree-vertices", "20k"});
  EXPECT_EQ(with_both["subtree_vertices"].value<int>(), 20000);
  EXPECT_EQ(with_both["mixers"].value<int>(), 3);
}

TEST_F(Config, SizesAreReadInEveryForm) {
  const std::vector<std::pair<std::string, std::string>> sizes = {
      {"512MiB", "512MiB"}, {"2GiB", "2GiB"},       {"2G", "2GiB"},
      {"2g", "2GiB"},       {"1e9", "1000000000"},  {"1GB", "1000000000"},
      {"1.5KiB", "1536"},   {"1073741824", "1GiB"}, {"1TiB", "1TiB"}};
  for (const auto& [text, printed] : sizes) {
    const toml::table root = toml::parse(Effective({"-M", text}).out);
    EXPECT_EQ(root["encode"]["memory"].value<std::string>(), printed) << text;
  }
}

TEST_F(Config, UnknownKeyNamesTheNearest) {
  ExpectRejected("[codec]\n\nchildern = 4\n", 3, "unknown key codec.childern");
  ExpectRejected("[codec]\n\nchildern = 4\n", 3, "codec.children");
  ExpectRejected("[encode]\nbitz = 4\n", 2, "encode.bits");
  ExpectRejected("[codec]\nbits = 12\n", 2, "encode.bits");
  ExpectRejected("children = 4\n", 1, "codec.children");
  ExpectRejected("[coder]\nchildren = 4\n", 1, "[codec]");
}

TEST_F(Config, WrongTypesAreRejected) {
  ExpectRejected("[codec]\nchildren = 2.5\n", 2, "integer");
  ExpectRejected("[codec]\nchildren = \"4\"\n", 2, "integer");
  ExpectRejected("[codec]\nmetric_a = true\n", 2, "number");
  ExpectRejected("[codec]\npredict_theta = 1\n", 2, "true or false");
  ExpectRejected("[codec]\nhierarchy = 0\n", 2, "text");
  ExpectRejected("[codec]\nhierarchy = \"loyd\"\n", 2, "\"lloyd\"");
  ExpectRejected("[encode]\nmemory = \"2 pounds\"\n", 2, "encode.memory");
  ExpectRejected("[encode]\nmemory = 1.5\n", 2, "encode.memory");
  ExpectRejected("[encode]\ntmp = 3\n", 2, "encode.tmp");
  ExpectRejected("codec = 3\n", 1, "codec");
}

TEST_F(Config, ValuesOutOfRangeAreRejected) {
  ExpectRejected("[codec]\nchildren = 9\n", 2, "2 .. 8");
  ExpectRejected("[codec]\nchildren = -1\n", 2, "2 .. 8");
  ExpectRejected("[codec]\nchildren = 4294967298\n", 2, "2 .. 8");
  ExpectRejected("[codec]\nsubtree_vertices = 16777217\n", 2, "1 .. 16777216");
  ExpectRejected("[codec]\neffort = 0\n", 2, "1 .. 9");
  ExpectRejected("[codec]\neffort = 10\n", 2, "1 .. 9");
  ExpectRejected("[codec]\ndensity_step = 5\n", 2, "0 .. 4");
  ExpectRejected("[codec]\nmixers = 0\n", 2, "1 .. 3");
  ExpectRejected("[codec]\nmodels = \"thin\"\n", 2, "light");
  ExpectRejected("[codec]\nmetric_a = 1.5\n", 2, "0 .. 1");
  ExpectRejected("[codec]\nmetric_b = nan\n", 2, "1 .. 64");
  ExpectRejected("[encode]\ntolerance = inf\n", 2, "tolerance");
  ExpectRejected("[encode]\ntolerance = -1\n", 2, "tolerance");
  ExpectRejected("[encode]\ntolerance = 1e41\n", 2, "tolerance");
  ExpectRejected("[codec]\nmetric_a = 9007199254740993\n", 2, "metric_a");
  ExpectRejected("[encode]\nbits = 0\n", 2, "1 .. 24");
  ExpectRejected("[encode]\nmemory = -5\n", 2, "encode.memory");
}

TEST_F(Config, BrokenAndMissingFilesAreRejected) {
  ExpectRejected("[codec\nchildren = 4\n", 1, "");
  ExpectRejected("[codec]\nchildren = 4\nchildren = 3\n", 3, "");
  ExpectError({"encode", "--print-config", "--config", Path("none.toml")}, 3, "none.toml");
  ExpectError({"encode", "--print-config", "--config", Path(".")}, 3, "directory");
  EXPECT_EQ(Effective({"--config", Write("")}).exit_code, 0);
}

}  // namespace
}  // namespace folprom::cli_test
