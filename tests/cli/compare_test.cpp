// The verbs compare and rd: reports, outputs, refusals.
#include <algorithm>

#include "tests/cli/program.h"

namespace folprom::cli_test {
namespace {

class Compare : public CliTest {
 protected:
  // Two triangles that lie 0.5 apart, and a scan.
  void SetUp() override {
    WriteText(Path("low.ply"), Triangle("0"));
    WriteText(Path("high.ply"), Triangle("0.5"));
    ASSERT_EQ(Run({"synth", "--vertices", "2000", "-o", Path("s.ply"), "-q"}).exit_code, 0);
  }

  static std::string Triangle(const std::string& z) {
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
           "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
           "0 0 " +
           z + "\n3 0 " + z + "\n0 4 " + z + "\n3 0 1 2\n";
  }
};

// Without what differs from run to run.
nlohmann::json Timeless(nlohmann::json report) {
  report.erase("seconds");
  report.erase("peak_rss_bytes");
  return report;
}

TEST_F(Compare, ReportsBothDirections) {
  const Outcome outcome = Run({"compare", Path("low.ply"), Path("high.ply"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const auto report = outcome.json();
  EXPECT_DOUBLE_EQ(report.at("diagonal"), 5);
  EXPECT_EQ(report.at("samples"), 500'000);
  for (const char* direction : {"forward", "backward"}) {
    for (const char* key : {"mean", "rms", "max"}) {
      EXPECT_NEAR(report.at(direction).at(key), 0.5, 1e-9);
      EXPECT_NEAR(report.at(direction).at(std::string(key) + "_relative"), 0.1, 1e-9);
    }
  }
  EXPECT_TRUE(report.contains("seconds") && report.contains("peak_rss_bytes"));
}

TEST_F(Compare, ReportsTheSameForEveryNumberOfThreads) {
  ASSERT_EQ(Run({"encode", Path("s.ply"), "-o", Path("s.folp"), "-q"}).exit_code, 0);
  std::vector<nlohmann::json> reports;
  for (const char* threads : {"1", "2", "5"}) {
    const Outcome outcome = Run(
        {"compare", Path("s.ply"), Path("s.folp"), "--samples", "50k", "-T", threads, "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    reports.push_back(Timeless(outcome.json()));
  }
  EXPECT_EQ(reports[1], reports[0]);
  EXPECT_EQ(reports[2], reports[0]);
  EXPECT_GT(reports[0].at("forward").at("mean"), 0);
  const double tolerance = Run({"info", Path("s.folp"), "--json"}).json().at("tolerance");
  EXPECT_LT(reports[0].at("forward").at("max"), 1.74 * tolerance);
}

TEST_F(Compare, RelativeToAPointThereIsNothing) {
  WriteText(Path("point.ply"),
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
            "property float z\nend_header\n0 0 1\n");
  const Outcome outcome = Run({"compare", Path("point.ply"), Path("low.ply"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(outcome.json().at("forward").at("mean_relative").is_null());
  EXPECT_DOUBLE_EQ(outcome.json().at("forward").at("mean"), 1);
}

TEST_F(Compare, TextNamesBothMeshes) {
  const Outcome outcome = Run({"compare", Path("low.ply"), Path("high.ply"), "--samples", "1k"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* part : {"low.ply", "high.ply", "A to B", "B to A", "0.5"}) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << outcome.out;
  }
}

TEST_F(Compare, RefusesWrongCalls) {
  ExpectError({"compare", Path("low.ply")}, 2, "B");
  ExpectError({"compare", Path("low.ply"), Path("high.ply"), "--samples", "0"}, 2, "--samples");
  ExpectError({"compare", Path("low.ply"), Path("none.ply")}, 3, "none.ply");
  WriteText(Path("cut.folp"),
            "\xf7"
            "FOLP\r\n");
  ExpectError({"compare", Path("low.ply"), Path("cut.folp")}, 4, "cut.folp");
}

TEST_F(Compare, RdWritesItsThreeFiles) {
  const Outcome outcome = Run({"rd", Path("s.ply"), "--bpv", "1,10,100", "--samples", "20k", "-o",
                               Path("curve"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto report = outcome.json();
  EXPECT_EQ(report, nlohmann::json::parse(FileText(Path("curve.json"))));
  ASSERT_EQ(report.at("points").size(), 3u);
  double rate = 0, error = 1e9;
  for (const auto& point : report.at("points")) {
    for (const char* key :
         {"requested", "vertices", "faces", "rms", "max", "forward", "backward"}) {
      EXPECT_TRUE(point.contains(key)) << key;
    }
    EXPECT_GT(point.at("bits_per_vertex"), rate);
    EXPECT_LT(point.at("mean"), error);
    EXPECT_EQ(point.at("mean"), std::max(point.at("forward").at("mean").get<double>(),
                                         point.at("backward").at("mean").get<double>()));
    rate = point.at("bits_per_vertex");
    error = point.at("mean");
  }
  EXPECT_EQ(report.at("points")[2].at("vertices"), 2000);
  EXPECT_EQ(rate, report.at("bits_per_vertex"));
  const std::string csv = FileText(Path("curve.csv"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
  EXPECT_TRUE(csv.starts_with("requested,bits_per_vertex,"));
  const std::string svg = FileText(Path("curve.svg"));
  EXPECT_TRUE(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
  for (const char* part :
       {"bits per vertex", "mean surface distance", "s.ply", "folprom, default"}) {
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  }
}

TEST_F(Compare, RdKeepsOutputsUnlessForced) {
  const std::vector<std::string> words = {"rd",        Path("s.ply"), "--bpv", "2",
                                          "--samples", "1k",          "-o",    Path("curve")};
  WriteText(Path("curve.svg"), "mine");
  ExpectError(words, 5, "curve.svg: exists already");
  EXPECT_EQ(FileText(Path("curve.svg")), "mine");
  std::vector<std::string> forced = words;
  forced.push_back("-f");
  EXPECT_EQ(Run(forced).exit_code, 0);
  EXPECT_NE(FileText(Path("curve.svg")), "mine");
}

TEST_F(Compare, RdTakesAConfig) {
  WriteText(Path("own.toml"), "[codec]\nchildren = 2\n");
  const std::vector<std::string> words = {"rd",        Path("s.ply"), "--bpv", "100",
                                          "--samples", "1k",          "--json"};
  std::vector<std::string> with_config = words;
  with_config.insert(with_config.end(), {"--config", Path("own.toml")});
  std::vector<std::string> with_bits = words;
  with_bits.insert(with_bits.end(), {"--bits", "8"});
  const auto bytes = [&](const std::vector<std::string>& arguments) {
    const Outcome outcome = Run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.json().at("bytes").get<uint64_t>();
  };
  EXPECT_NE(bytes(with_config), bytes(words));
  EXPECT_LT(bytes(with_bits), bytes(words));
}

TEST_F(Compare, RdRefusesWrongCalls) {
  ExpectError({"rd"}, 2, "SCAN");
  for (const char* rates : {"", "0", "-1", "1,,2", "1,", "x", "1;2", "nan", "inf"}) {
    ExpectError({"rd", Path("s.ply"), "--bpv", rates}, 2, "--bpv");
  }
  ExpectError({"rd", Path("s.ply"), "--bits", "25"}, 2, "--bits");
  ExpectError({"rd", Path("none.ply")}, 3, "none.ply");
  ExpectError({"rd", Path("s.ply"), "--config", Path("none.toml")}, 3, "none.toml");
}

}  // namespace
}  // namespace folprom::cli_test
