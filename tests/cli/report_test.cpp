// What encode, decode, info and verify print, and their exit codes on good and bad files.
#include <algorithm>
#include <cstring>
#include <limits>

#include "tests/cli/program.h"

namespace folprom::cli_test {
namespace {

class Report : public CliTest {
 protected:
  // A scan of 3,000 vertices, encoded.
  void SetUp() override {
    ASSERT_EQ(Run({"synth", "--vertices", "3000", "-o", Path("s.ply"), "-q"}).exit_code, 0);
    encoded_ = Run({"encode", Path("s.ply"), "-o", Path("s.folp"), "--json"});
    ASSERT_EQ(encoded_.exit_code, 0) << encoded_.err;
  }

  Outcome encoded_;
};

void ExpectKeys(const nlohmann::json& object, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) EXPECT_TRUE(object.contains(key)) << key;
}

TEST_F(Report, EncodeAsJson) {
  const auto report = encoded_.json();
  ExpectKeys(report, {"vertices", "faces", "bytes", "bits_per_vertex", "seconds", "peak_rss_bytes",
                      "subtrees", "layers", "spill_bytes", "bits", "warnings", "output"});
  EXPECT_EQ(report.at("vertices"), 3000);
  EXPECT_EQ(report.at("bytes"), std::filesystem::file_size(Path("s.folp")));
  EXPECT_DOUBLE_EQ(report.at("bits_per_vertex"), report.at("bytes").get<double>() * 8 / 3000);
  const auto& bits = report.at("bits");
  ExpectKeys(bits, {"split", "root", "theta", "rho", "z", "refinement", "connected", "pivots",
                    "sides", "exceptions", "seams", "rests", "attributes"});
  double sum = 0;
  for (const auto& kind : bits) sum += kind.get<double>();
  EXPECT_GT(sum, 0.9 * 8 * report.at("bytes").get<double>());
  EXPECT_LT(sum, 8 * report.at("bytes").get<double>());
  EXPECT_GE(report.at("subtrees"), 1);
  EXPECT_GE(report.at("layers"), 1);
  EXPECT_EQ(encoded_.err, "");
}

TEST_F(Report, InfoAsJson) {
  const Outcome outcome = Run({"info", Path("s.folp"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto info = outcome.json();
  ExpectKeys(info, {"format_version", "vertices", "faces", "bytes", "bytes_present",
                    "layers_present", "layers_total", "subtrees", "tolerance", "box_lo", "box_hi",
                    "codec", "table_bytes", "checksum_bytes", "flush_bytes", "overhead"});
  ExpectKeys(info.at("bits_per_vertex_by_kind"),
             {"split", "offsets", "refinement", "connectivity", "exceptions", "seams"});
  EXPECT_EQ(info.at("vertices"), 3000);
  EXPECT_EQ(info.at("bytes"), encoded_.json().at("bytes"));
  EXPECT_EQ(info.at("codec").at("hierarchy"), "quadric");
  const auto& layers = info.at("layers");
  ASSERT_EQ(layers.size(), encoded_.json().at("layers").get<size_t>());
  for (const auto& layer : layers) {
    ExpectKeys(layer, {"bytes", "end_byte", "vertices", "faces", "error_bound", "bits_per_vertex"});
  }
  EXPECT_EQ(layers.back().at("end_byte"), info.at("bytes"));
  EXPECT_EQ(layers.back().at("vertices"), 3000);
}

TEST_F(Report, OfTheEffort) {
  EXPECT_EQ(Run({"info", Path("s.folp"), "--json"}).json().at("codec").at("effort"), 5);
  for (const char* effort : {"1", "9"}) {
    ASSERT_EQ(Run({"encode", Path("s.ply"), "-o", Path("e.folp"), "-f", "--effort", effort, "-q"})
                  .exit_code,
              0);
    const auto info = Run({"info", Path("e.folp"), "--json"}).json();
    EXPECT_EQ(std::to_string(info.at("codec").at("effort").get<int>()), effort);
    EXPECT_NE(Run({"info", Path("e.folp")}).out.find(std::string("effort ") + effort),
              std::string::npos);
    EXPECT_EQ(Run({"verify", Path("e.folp"), "--against", Path("s.ply"), "-q"}).exit_code, 0);
  }
}

TEST_F(Report, OfAnExactFile) {
  const Outcome encoded = Run({"encode", Path("s.ply"), "-o", Path("e.folp"), "--exact"});
  ASSERT_EQ(encoded.exit_code, 0) << encoded.err;
  const auto info = Run({"info", Path("e.folp"), "--json"}).json();
  ExpectKeys(info.at("exact"), {"type", "radix", "exponent", "bits", "has_rests"});
  EXPECT_EQ(info.at("tolerance"), 0);
  EXPECT_TRUE(Run({"info", Path("s.folp"), "--json"}).json().at("exact").is_null());
  EXPECT_NE(Run({"info", Path("e.folp")}).out.find("exact: every bit of a float"),
            std::string::npos);
  const Outcome verified = Run({"verify", Path("e.folp"), "--against", Path("s.ply"), "--json"});
  ASSERT_EQ(verified.exit_code, 0) << verified.err;
  EXPECT_EQ(verified.json().at("lossless"), true);
  EXPECT_EQ(verified.json().at("max_position_error"), 0);
}

TEST_F(Report, InfoAsTableHasARowForEachLayer) {
  const Outcome outcome = Run({"info", Path("s.folp")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto layers = encoded_.json().at("layers").get<size_t>();
  const std::string table = outcome.out.substr(outcome.out.find("\nlayer") + 1);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), static_cast<long>(layers) + 1);
}

TEST_F(Report, DecodeAsJson) {
  const Outcome outcome = Run({"decode", Path("s.folp"), "-o", Path("d.ply"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto report = outcome.json();
  ExpectKeys(report, {"vertices", "faces", "seconds", "peak_rss_bytes", "layers", "layers_total",
                      "complete", "bytes_read", "error_bound", "warnings"});
  EXPECT_EQ(report.at("vertices"), 3000);
  EXPECT_EQ(report.at("faces"), encoded_.json().at("faces"));
  EXPECT_EQ(report.at("complete"), true);
  EXPECT_EQ(report.at("layers"), report.at("layers_total"));
}

TEST_F(Report, DecodeOfOneLayerIsCoarser) {
  const Outcome outcome =
      Run({"decode", Path("s.folp"), "-o", Path("d.ply"), "--layers", "1", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto report = outcome.json();
  EXPECT_EQ(report.at("layers"), 1);
  EXPECT_LT(report.at("vertices"), 3000);
  EXPECT_LT(report.at("bytes_read"), encoded_.json().at("bytes"));
}

TEST_F(Report, VerifyIsLosslessWithAndWithoutTheOriginal) {
  const Outcome alone = Run({"verify", Path("s.folp"), "--json"});
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_EQ(alone.json().at("lossless"), true);
  EXPECT_EQ(alone.json().at("against"), false);
  EXPECT_TRUE(alone.json().at("max_position_error").is_null());
  const Outcome against = Run({"verify", Path("s.folp"), "--against", Path("s.ply"), "--json"});
  ASSERT_EQ(against.exit_code, 0) << against.err;
  EXPECT_EQ(against.json().at("lossless"), true);
  EXPECT_LE(against.json().at("max_position_error"), against.json().at("tolerance"));
  ExpectKeys(against.json(), {"vertices", "faces", "reason", "seconds"});
}

TEST_F(Report, VerifyAgainstAnotherScanGivesFour) {
  const Outcome other =
      Run({"synth", "--vertices", "3000", "--seed", "2", "-o", Path("t.ply"), "-q"});
  ASSERT_EQ(other.exit_code, 0);
  const Outcome outcome = Run({"verify", Path("s.folp"), "--against", Path("t.ply"), "--json"});
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_EQ(outcome.json().at("lossless"), false);
  EXPECT_NE(outcome.json().at("reason"), "");
  EXPECT_NE(outcome.err.find("not lossless"), std::string::npos) << outcome.err;
}

TEST_F(Report, VerifyAgainstAScanWithACoordinateThatIsNotFiniteGivesFour) {
  const std::string whole = FileText(Path("s.ply"));
  const size_t body = whole.find("end_header\n") + 11;
  for (const float value :
       {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::quiet_NaN(),
        std::numeric_limits<float>::infinity()}) {
    for (const size_t coordinate : {size_t{0}, size_t{4501}, size_t{8999}}) {
      std::string scan = whole;
      std::memcpy(scan.data() + body + coordinate * sizeof value, &value, sizeof value);
      WriteText(Path("nan.ply"), scan);
      const Outcome outcome = Run({"verify", Path("s.folp"), "--against", Path("nan.ply"), "-q"});
      EXPECT_EQ(outcome.exit_code, 4) << coordinate;
      EXPECT_NE(outcome.err.find("not lossless"), std::string::npos) << outcome.err;
    }
  }
}

TEST_F(Report, FileCutInsideTheTableGivesFour) {
  WriteText(Path("cut.folp"), FileText(Path("s.folp")).substr(0, 20));
  ExpectError({"info", Path("cut.folp")}, 4, "cut.folp");
  ExpectError({"decode", Path("cut.folp"), "-o", Path("d.ply"), "--json"}, 4, "cut.folp");
  EXPECT_FALSE(std::filesystem::exists(Path("d.ply")));
}

TEST_F(Report, FileCutInsideTheFirstLayerIsNamed) {
  const auto info = Run({"info", Path("s.folp"), "--json"}).json();
  const auto end = info.at("layers").at(0).at("end_byte").get<size_t>();
  WriteText(Path("cut.folp"), FileText(Path("s.folp")).substr(0, end - 1));
  ExpectError({"compare", Path("s.folp"), Path("cut.folp"), "--json"}, 4, Path("cut.folp") + ": ");
  ExpectError({"decode", Path("cut.folp"), "-o", Path("d.ply")}, 4, Path("cut.folp") + ": ");
}

TEST_F(Report, CutFileIsNotLossless) {
  const std::string whole = FileText(Path("s.folp"));
  WriteText(Path("cut.folp"), whole.substr(0, whole.size() - 1));
  EXPECT_EQ(Run({"verify", Path("cut.folp"), "--json"}).exit_code, 4);
}

TEST_F(Report, WhatIsNotKeptAsItWasIsAWarning) {
  WriteText(Path("strip.ply"),
            "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
            "property float z\nproperty list uchar int red\nelement tristrips 1\n"
            "property list int int vertex_indices\nend_header\n"
            "0 0 0 0\n1 0 0 0\n0 1 0 0\n1 1 1 0\n8 0 1 2 3 -1 1 2 3\n");
  const Outcome outcome = Run({"encode", Path("strip.ply"), "-o", Path("o.folp"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(
      outcome.json().at("warnings"),
      (std::vector<std::string>{"2 triangle strips unrolled", "properties not kept: vertex.red"}));
}

TEST_F(Report, AttributesAreToldWithTheirBits) {
  WriteText(Path("colour.ply"),
            "ply\nformat ascii 1.0\ncomment one\nelement vertex 4\nproperty float x\n"
            "property float y\nproperty float z\nproperty uchar red\nproperty float quality\n"
            "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
            "0 0 0 9 0.5\n1 0 0 8 0.5\n0 1 0 7 0.5\n1 1 1 200 0.5\n3 0 1 2\n");
  const Outcome outcome = Run({"encode", Path("colour.ply"), "-o", Path("c.folp"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.json().at("warnings"), std::vector<std::string>());
  for (const auto& report : {outcome.json(), Run({"info", Path("c.folp"), "--json"}).json()}) {
    const auto& attributes = report.at("attributes");
    ASSERT_EQ(attributes.size(), 2u);
    EXPECT_EQ(attributes.at(0).at("name"), "red");
    EXPECT_EQ(attributes.at(0).at("type"), "uint8");
    EXPECT_GT(attributes.at(0).at("bits_per_vertex").get<double>(), 0);
    EXPECT_EQ(attributes.at(1).at("type"), "float32");
    EXPECT_EQ(attributes.at(1).at("bits_per_vertex"), 0);
  }
  const std::string text = Run({"info", Path("c.folp")}).out;
  EXPECT_NE(text.find("uint8 red: "), std::string::npos) << text;
  EXPECT_NE(text.find("comment one\n"), std::string::npos) << text;
  const auto verified =
      Run({"verify", Path("c.folp"), "--against", Path("colour.ply"), "--json"}).json();
  EXPECT_EQ(verified.at("attributes"), 2);

  const Outcome without =
      Run({"encode", Path("colour.ply"), "-o", Path("n.folp"), "--json", "--no-attributes"});
  ASSERT_EQ(without.exit_code, 0) << without.err;
  EXPECT_EQ(without.json().at("warnings"),
            (std::vector<std::string>{"properties not kept: vertex.red, vertex.quality"}));
  EXPECT_TRUE(Run({"info", Path("n.folp"), "--json"}).json().at("attributes").empty());
}

TEST_F(Report, UnreadableScanGivesThree) {
  WriteText(Path("bad.ply"), "ply\nformat binary_little_endian 1.0\nelement vertex 5\n");
  ExpectError({"encode", Path("bad.ply"), "-o", Path("o.folp")}, 3, "bad.ply");
  EXPECT_FALSE(std::filesystem::exists(Path("o.folp")));
}

TEST_F(Report, RunnersGiveTheSameFile) {
  const std::string whole = FileText(Path("s.folp"));
  for (const char* runner : {"serial", "shuffled:1", "shuffled:99", "tbb"}) {
    ASSERT_EQ(Run({"encode", Path("s.ply"), "-o", Path("o.folp"), "-f", "-q", "--runner", runner})
                  .exit_code,
              0);
    EXPECT_EQ(FileText(Path("o.folp")), whole) << runner;
  }
}

}  // namespace
}  // namespace folprom::cli_test
