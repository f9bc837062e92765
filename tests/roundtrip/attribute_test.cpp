// What vertices have beside their position comes back, bit for bit and with every LOD.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string>

#include "tests/support/attribute_ply.h"
#include "tests/support/bit_mesh.h"
#include "tests/support/codec.h"
#include "tests/support/coders.h"
#include "tests/support/files.h"
#include "tests/support/meshes.h"
#include "tests/support/ply.h"
#include "tests/support/surfaces.h"

namespace folprom::support {
namespace {

class AttributeTest : public ::testing::Test {
 protected:
  EncodeReport Code(const AttributeMesh& content, const EncodeOptions& options) {
    original_ = content;
    WriteAttributes(scan_, content);
    return Encode(scan_, folp_, options);
  }
  AttributeMesh Decoded(DecodeOptions options = {}) {
    options.overwrite = true;
    Decode(folp_, folder_.File("out.ply"), options);
    return ReadAttributes(folder_.File("out.ply"));
  }
  /// Of an exact encoding.
  void ExpectWhole() {
    const AttributeMesh decoded = Decoded();
    ASSERT_EQ(decoded.mesh.attributes.size(), original_.mesh.attributes.size());
    for (size_t a = 0; a < decoded.mesh.attributes.size(); ++a) {
      EXPECT_EQ(decoded.mesh.attributes[a].name, original_.mesh.attributes[a].name);
      EXPECT_EQ(decoded.mesh.attributes[a].type, original_.mesh.attributes[a].type);
    }
    EXPECT_EQ(decoded.before_position, original_.before_position);
    EXPECT_TRUE(SortedVertices(decoded.mesh) == SortedVertices(original_.mesh));
    const VerifyReport by_digest = Verify(folp_, "");
    EXPECT_TRUE(by_digest.lossless) << by_digest.reason;
    const VerifyReport by_scan = Verify(folp_, scan_);
    EXPECT_TRUE(by_scan.lossless) << by_scan.reason;
    EXPECT_EQ(by_scan.attributes, original_.mesh.attributes.size());
  }

  TemporaryFolder folder_;
  std::string scan_ = folder_.File("scan.ply"), folp_ = folder_.File("scan.folp");
  AttributeMesh original_;
};

TEST_F(AttributeTest, EveryTypeComesBackBitForBit) {
  for (uint32_t subtree_vertices : {100000u, 200u}) {
    AttributeMesh content{IntegerTerrain(40, 30, 1), 3, {}};
    content.mesh.attributes = EveryType(content.mesh, 7);
    EncodeOptions options = ExactOptions(subtree_vertices);
    options.overwrite = true;
    EXPECT_EQ(Code(content, options).warnings, std::vector<std::string>());
    ExpectWhole();
  }
}

TEST_F(AttributeTest, MeshesThatAreHardKeepThem) {
  AttributeMesh soup{NonManifoldSoup(150, 400, 3), 0, {}};
  soup.mesh.attributes = EveryType(soup.mesh, 1);
  Code(soup, ExactOptions(40));
  ExpectWhole();
}

TEST_F(AttributeTest, CoincidentAndIsolatedVerticesKeepTheirOwn) {
  AttributeMesh content{{}, 0, {}};
  content.mesh.positions = {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {0, 0, 0}, {0, 0, 0}, {5, 5, 5}};
  content.mesh.faces = {{0, 1, 2}, {3, 2, 1}};
  DecodedAttribute label{"label", ScalarType::kUint16, {}};
  for (const uint16_t value : std::array<uint16_t, 6>{11, 22, 33, 44, 55, 66}) {
    AppendValue(value, &label);
  }
  content.mesh.attributes = {label};
  Code(content, ExactOptions());
  ExpectWhole();
}

TEST_F(AttributeTest, SingleVerticesKeepThem) {
  AttributeMesh content{{}, 0, {}};
  content.mesh.positions = {{1, 2, 3}};
  content.mesh.attributes = {{"quality", ScalarType::kFloat32, {0, 0, 0xc0, 0x7f}}};
  Code(content, ExactOptions());
  ExpectWhole();
}

TEST_F(AttributeTest, LodsCarryTheValuesOfTheirVertices) {
  AttributeMesh content{IntegerTerrain(60, 50, 2), 0, {}};
  content.mesh.attributes = Colours(content.mesh, 5);
  Code(content, ExactOptions());
  const std::vector<Mesh> lods = EveryLod(folp_);
  ASSERT_GT(lods.size(), 5u);
  ASSERT_TRUE(SortedVertices(lods.back()) == SortedVertices(content.mesh));
  // In a single subtree a vertex keeps its number from its first LOD on.
  const std::vector<std::string> whole = AttributeRows(lods.back());
  for (const Mesh& lod : lods) {
    const std::vector<std::string> rows = AttributeRows(lod);
    ASSERT_TRUE(std::equal(rows.begin(), rows.end(), whole.begin())) << rows.size();
  }
}

TEST_F(AttributeTest, FilesOfALodHaveThoseOfTheDecoderFromMemory) {
  AttributeMesh content{IntegerTerrain(60, 50, 2), 1, {}};
  content.mesh.attributes = Colours(content.mesh, 6);
  EncodeOptions options;
  options.codec.subtree_vertices = 500;
  Code(content, options);
  for (uint32_t layers : {1u, 4u, 9u}) {
    DecodeOptions decode;
    decode.layers = layers;
    EXPECT_TRUE(AttributeRows(Decoded(decode).mesh) == AttributeRows(LodOf(folp_, layers)));
  }
}

TEST_F(AttributeTest, RegionsCarryThem) {
  AttributeMesh content{IntegerTerrain(60, 50, 3), 2, {}};
  content.mesh.attributes = Colours(content.mesh, 7);
  Code(content, ExactOptions(400));
  const std::vector<std::string> all = SortedVertices(content.mesh);
  const auto& positions = content.mesh.positions;
  DecodeOptions box;
  box.use_region = true;
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto [lo, hi] =
        std::minmax_element(positions.begin(), positions.end(),
                            [axis](const Point& a, const Point& b) { return a[axis] < b[axis]; });
    box.region_lo[axis] = (*lo)[axis];
    box.region_hi[axis] = axis == 2 ? (*hi)[axis] : ((*lo)[axis] + (*hi)[axis]) / 2;
  }
  const std::vector<std::string> part = SortedVertices(Decoded(box).mesh);
  EXPECT_GT(part.size(), positions.size() / 8);
  EXPECT_LT(part.size(), positions.size() / 2);
  EXPECT_TRUE(std::includes(all.begin(), all.end(), part.begin(), part.end()));
}

TEST_F(AttributeTest, CutFilesGiveThoseOfTheLayersThatAreThere) {
  AttributeMesh content{IntegerTerrain(50, 40, 4), 0, {}};
  content.mesh.attributes = Colours(content.mesh, 8);
  EncodeOptions options;
  options.codec.subtree_vertices = 500;
  Code(content, options);
  const std::vector<Mesh> lods = EveryLod(folp_);
  std::vector<uint8_t> bytes = FileBytes(folp_);
  for (size_t parts : {2, 3, 5}) {
    std::ofstream(folder_.File("cut.folp"), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size() / parts));
    DecodeOptions overwrite;
    overwrite.overwrite = true;
    const DecodeReport report =
        Decode(folder_.File("cut.folp"), folder_.File("out.ply"), overwrite);
    ASSERT_LT(report.layers, lods.size());
    EXPECT_TRUE(AttributeRows(ReadAttributes(folder_.File("out.ply")).mesh) ==
                AttributeRows(lods[report.layers - 1]));
  }
}

TEST_F(AttributeTest, WhatIsTheSameEverywhereCostsNothing) {
  AttributeMesh content{IntegerTerrain(50, 40, 5), 0, {}};
  content.mesh.attributes = Colours(content.mesh, 9);
  EncodeReport report = Code(content, {});
  ASSERT_EQ(report.attributes.size(), 4u);
  EXPECT_GT(report.attributes[0].bits, 0);
  EXPECT_EQ(report.attributes[3].name, "alpha");
  EXPECT_EQ(report.attributes[3].bits, 0);
  EXPECT_DOUBLE_EQ(report.bits.attributes, report.attributes[0].bits + report.attributes[1].bits +
                                               report.attributes[2].bits);
}

TEST_F(AttributeTest, GreyCostsLittleMoreThanOneOfItsColours) {
  AttributeMesh content{IntegerTerrain(70, 60, 5), 0, {}};
  content.mesh.attributes = Colours(content.mesh, 9);
  content.mesh.attributes[1].values = content.mesh.attributes[0].values;
  content.mesh.attributes[2].values = content.mesh.attributes[0].values;
  const EncodeReport report = Code(content, {});
  EXPECT_LT(report.attributes[1].bits + report.attributes[2].bits, report.attributes[0].bits / 5);
}

TEST_F(AttributeTest, UnitNormalsCostLittleInTheirLastComponent) {
  AttributeMesh content{BumpySphere(3000, false, 1), 0, {}};
  std::vector<DecodedAttribute> normals;
  for (const char* name : {"nx", "ny", "nz"}) {
    normals.push_back({name, ScalarType::kFloat32, {}});
  }
  for (const Point& p : content.mesh.positions) {
    const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    for (size_t axis = 0; axis < 3; ++axis) {
      AppendValue(static_cast<float>(p[axis] / length), &normals[axis]);
    }
  }
  content.mesh.attributes = normals;
  const EncodeReport report = Code(content, ExactOptions());
  ExpectWhole();
  EXPECT_LT(report.attributes[2].bits, report.attributes[0].bits / 2);
}

TEST_F(AttributeTest, CommentsComeBack) {
  AttributeMesh content{IntegerTerrain(9, 9, 1), 0, {}};
  content.comments = {"comment made by a scanner", "obj_info num_cols 512", "comment",
                      "comment \xc3\xa9t\xc3\xa9  two blanks "};
  Code(content, {});
  EXPECT_EQ(Decoded().comments, content.comments);
  EXPECT_TRUE(Verify(folp_, scan_).lossless);
}

TEST_F(AttributeTest, CommentsBeyondTheLimitAreDroppedWithAWarning) {
  AttributeMesh content{IntegerTerrain(9, 9, 1), 0, {}};
  content.comments = {"comment " + std::string(50000, 'a'), "comment " + std::string(50000, 'b')};
  const EncodeReport report = Code(content, {});
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_NE(report.warnings[0].find("1 comment dropped"), std::string::npos) << report.warnings[0];
  EXPECT_EQ(Decoded().comments, std::vector<std::string>{content.comments[0]});
}

TEST_F(AttributeTest, DroppedOnesLeaveTheBytesOfABareMesh) {
  const Mesh bare = IntegerTerrain(40, 30, 6);
  EncodeOptions options = ExactOptions(300);
  WriteAttributes(folder_.File("bare.ply"), {bare, 0, {}});
  Encode(folder_.File("bare.ply"), folder_.File("bare.folp"), options);
  AttributeMesh content{bare, 2, {"comment one"}};
  content.mesh.attributes = Colours(bare, 3);
  options.attributes = false;
  const EncodeReport report = Code(content, options);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_EQ(report.warnings[0],
            "properties not kept: vertex.red, vertex.green, vertex.blue, vertex.alpha");
  EXPECT_EQ(FileBytes(folp_), FileBytes(folder_.File("bare.folp")));
}

TEST_F(AttributeTest, TheCoderOfThePaperDropsThemWithAWarning) {
  AttributeMesh content{IntegerTerrain(20, 20, 6), 0, {"comment one"}};
  content.mesh.attributes = Colours(content.mesh, 3);
  EncodeOptions options;
  options.codec = LloydSettings();
  EXPECT_EQ(Code(content, options).warnings.size(), 1u);
  const AttributeMesh decoded = Decoded();
  EXPECT_TRUE(decoded.mesh.attributes.empty());
  EXPECT_EQ(decoded.comments, content.comments);
}

TEST_F(AttributeTest, VerifyNoticesOneChangedValue) {
  AttributeMesh content{IntegerTerrain(40, 30, 7), 0, {"comment one"}};
  content.mesh.attributes = Colours(content.mesh, 4);
  EncodeOptions options;
  options.codec.subtree_vertices = 300;
  Code(content, options);
  AttributeMesh changed = content;
  changed.mesh.attributes[1].values[777] ^= 1;
  WriteAttributes(scan_, changed);
  VerifyReport report = Verify(folp_, scan_);
  EXPECT_FALSE(report.lossless);
  EXPECT_EQ(report.reason, "an attribute differs from that of the scan in its bits");

  changed = content;
  changed.mesh.attributes[1].name = "verde";
  WriteAttributes(scan_, changed);
  EXPECT_EQ(Verify(folp_, scan_).reason, "the vertices of scan and file have other attributes");

  changed = content;
  changed.comments = {"comment two"};
  WriteAttributes(scan_, changed);
  EXPECT_EQ(Verify(folp_, scan_).reason, "the comments of scan and file differ");
}

TEST_F(AttributeTest, InfoTellsOfThem) {
  AttributeMesh content{IntegerTerrain(40, 30, 7), 0, {"comment one"}};
  content.mesh.attributes = Colours(content.mesh, 4);
  const EncodeReport report = Code(content, {});
  const FileInfo info = ReadInfo(folp_).value();
  ASSERT_EQ(info.attributes.size(), 4u);
  for (size_t a = 0; a < 4; ++a) {
    EXPECT_EQ(info.attributes[a].name, content.mesh.attributes[a].name);
    EXPECT_EQ(info.attributes[a].type, ScalarType::kUint8);
    EXPECT_NEAR(info.attributes[a].bits, report.attributes[a].bits, 1);
  }
  EXPECT_EQ(info.remarks, content.comments);
}

TEST_F(AttributeTest, OtherFormatsWarnOfWhatTheyDoNotHold) {
  AttributeMesh content{IntegerTerrain(20, 20, 7), 0, {"comment one"}};
  content.mesh.attributes = Colours(content.mesh, 4);
  content.mesh.attributes.push_back(content.mesh.attributes[0]);
  content.mesh.attributes.back().name = "level";
  Code(content, {});
  for (const std::string name : {"out.obj", "out.off", "out.stl"}) {
    const std::vector<std::string> warnings = Decode(folp_, folder_.File(name)).warnings;
    ASSERT_GE(warnings.size(), 2u) << name;
    const std::string lost = name == "out.stl" ? ": red, green, blue, alpha, level" : ": level";
    EXPECT_TRUE(warnings[0].ends_with(lost)) << warnings[0];
  }
}

/// Normals of a bumpy sheet, a quality, and a flag that is no float.
AttributeMesh Sheet() {
  AttributeMesh content{IntegerTerrain(60, 50, 3), 0, {}};
  std::vector<DecodedAttribute>& all = content.mesh.attributes;
  for (const char* name : {"nx", "ny", "nz"}) all.push_back({name, ScalarType::kFloat32, {}});
  all.push_back({"quality", ScalarType::kFloat64, {}});
  all.push_back({"flag", ScalarType::kUint8, {}});
  for (const auto& p : content.mesh.positions) {
    const double x = std::sin(p[0] / 9), y = std::cos(p[1] / 7),
                 size = std::sqrt(x * x + y * y + 1);
    AppendValue(static_cast<float>(x / size), &all[0]);
    AppendValue(static_cast<float>(y / size), &all[1]);
    AppendValue(static_cast<float>(1 / size), &all[2]);
    AppendValue(x * y * 1000, &all[3]);
    AppendValue(static_cast<uint8_t>(p[0] > 3), &all[4]);
  }
  return content;
}

TEST_F(AttributeTest, RoundedOnesAreWithinHalfAStepAndTakeFewerBits) {
  const EncodeReport whole = Code(Sheet(), ExactOptions());
  EncodeOptions options = ExactOptions();
  options.overwrite = options.keep_order = true;
  options.attribute_bits = {"normal=10", "quality=16"};
  const EncodeReport report = Encode(scan_, folp_, options);
  EXPECT_TRUE(report.warnings.empty());
  const AttributeMesh decoded = Decoded();
  const auto real = [](const DecodedAttribute& attribute, size_t vertex) {
    if (attribute.type == ScalarType::kFloat64) {
      double value;
      std::memcpy(&value, &attribute.values[vertex * sizeof value], sizeof value);
      return value;
    }
    float value;
    std::memcpy(&value, &attribute.values[vertex * sizeof value], sizeof value);
    return static_cast<double>(value);
  };
  for (size_t a = 0; a < 4; ++a) {
    const double step = report.attributes[a].step;
    EXPECT_GT(step, 0);
    EXPECT_EQ(ReadInfo(folp_).value().attributes[a].step, step);
    EXPECT_LT(report.attributes[a].bits, whole.attributes[a].bits);
    double largest = 0;
    for (size_t v = 0; v < decoded.mesh.positions.size(); ++v) {
      largest = std::max(largest, std::fabs(real(decoded.mesh.attributes[a], v) -
                                            real(original_.mesh.attributes[a], v)));
    }
    EXPECT_LE(largest, 0.501 * step);
    EXPECT_GT(largest, 0.3 * step);
  }
  EXPECT_LT(report.bits.attributes, 0.6 * whole.bits.attributes);
  EXPECT_EQ(decoded.mesh.attributes[4].values, original_.mesh.attributes[4].values);
  EXPECT_EQ(report.attributes[4].step, 0);
  for (const bool keep_order : {true, false}) {
    options.keep_order = keep_order;
    Encode(scan_, folp_, options);
    const VerifyReport verified = Verify(folp_, scan_);
    EXPECT_TRUE(verified.lossless) << verified.reason;
    EXPECT_EQ(verified.attributes, 5u);
    EXPECT_EQ(verified.rounded_attributes, 4u);
    EXPECT_TRUE(Verify(folp_, "").lossless);
  }
}

TEST_F(AttributeTest, OneThatIsRoundedElsewhereIsSeenByVerify) {
  AttributeMesh content = Sheet();
  EncodeOptions options = ExactOptions();
  options.attribute_bits = {"quality=10"};
  Code(content, options);
  double value = 0;
  std::vector<uint8_t>& values = content.mesh.attributes[3].values;
  std::memcpy(&value, &values[800], sizeof value);
  value += 2000.0 / 1023;
  std::memcpy(&values[800], &value, sizeof value);
  WriteAttributes(folder_.File("other.ply"), content);
  EXPECT_TRUE(Verify(folp_, scan_).lossless);
  EXPECT_FALSE(Verify(folp_, folder_.File("other.ply")).lossless);
}

TEST_F(AttributeTest, BitsOfWhatCannotBeRoundedAreAWarningOrRefused) {
  AttributeMesh content = Sheet();
  const float nan = std::nanf("");
  std::memcpy(content.mesh.attributes[0].values.data(), &nan, sizeof nan);
  EncodeOptions options = ExactOptions();
  options.attribute_bits = {"nx=8", "flag=3", "none=3"};
  const EncodeReport report = Code(content, options);
  ASSERT_EQ(report.warnings.size(), 3u);
  EXPECT_NE(report.warnings[0].find("no float flag"), std::string::npos) << report.warnings[0];
  EXPECT_NE(report.warnings[1].find("no float none"), std::string::npos) << report.warnings[1];
  EXPECT_NE(report.warnings[2].find("not finite"), std::string::npos) << report.warnings[2];
  ExpectWhole();
  for (const char* text : {"normal", "normal=0", "normal=25", "=8", "", "normal=1x", "normal=-1"}) {
    options.attribute_bits = {text};
    const Result<void> checked = CheckOptions(options);
    ASSERT_FALSE(checked.ok()) << text;
    EXPECT_EQ(checked.error().kind, ErrorKind::kUsage);
  }
}

TEST_F(AttributeTest, ColoursOfLauranaTakeAtMostFourteenBits) {
  const std::string scan = SharedFile("hard/Laurana50k.ply");
  if (scan.empty()) GTEST_SKIP() << kNoSharedData;
  const EncodeReport report = Encode(scan, folp_, ExactOptions());
  EXPECT_LE(report.bits.attributes, 14.0 * static_cast<double>(report.vertices));
  Decode(folp_, folder_.File("out.ply"));
  EXPECT_TRUE(SortedVertices(ReadAttributes(folder_.File("out.ply")).mesh) ==
              SortedVertices(ReadAttributes(scan).mesh));
  EXPECT_TRUE(Verify(folp_, scan).lossless);
}

}  // namespace
}  // namespace folprom::support
