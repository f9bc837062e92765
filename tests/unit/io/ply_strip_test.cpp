#include <gtest/gtest.h>

#include "ply_builder.h"
#include "support.h"

namespace folprom::io {
namespace {

using enum ScalarType;
using testing::kAllFormats;
using testing::PlyBuilder;
using testing::TypeName;

std::string StripsOf(PlyFormat format, const std::vector<std::vector<double>>& strips,
                     ScalarType type = kInt32, int vertex_count = 9) {
  PlyBuilder ply(format);
  ply.Header("element vertex " + std::to_string(vertex_count));
  for (const char* axis : {"x", "y", "z"}) ply.Header(std::string("property char ") + axis);
  ply.Header("element tristrips " + std::to_string(strips.size())).Header("property char layer");
  ply.Header("property list int " + TypeName(type, false) + " vertex_indices");
  ply.Header("property char last").Body();
  for (int v = 0; v < vertex_count; ++v) ply.Value(kInt8, 1).Value(kInt8, 0).Value(kInt8, 2).End();
  for (const auto& strip : strips) {
    ply.Value(kInt8, 1).List(kInt32, type, strip).Value(kInt8, 2).End();
  }
  return ply.bytes();
}

TEST(PlyStrips, AlternateTheirWindingAndBeginAnewAtMinusOne) {
  for (const PlyFormat format : kAllFormats) {
    const testing::TemporaryFolder folder;
    const auto source =
        testing::OpenBytes(
            folder,
            StripsOf(format,
                     {{0, 1, 2, 3, 4, -1, 5, 6, 7, -1, -1, 1, 2, -1}, {8, 7, 6, 5}, {}, {3, 2}}))
            .value();
    EXPECT_EQ(
        testing::AllBlocks(*source).value().triangles,
        (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {5, 6, 7}, {8, 7, 6}, {6, 7, 5}}));
    EXPECT_EQ(source->notes().strips, 3u);
    EXPECT_EQ(source->notes().polygons_triangulated, 0u);
  }
}

TEST(PlyStrips, DropStitchesAndKeepTheWindingBehindThem) {
  for (const PlyFormat format : kAllFormats) {
    const auto mesh = testing::MeshOf(StripsOf(format, {{0, 1, 2, 2, 3, 3, 4, 5}})).value();
    // 012 | 122 223 233 334 are stitches | 3,4,5 at an odd place
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {4, 3, 5}}));
  }
}

TEST(PlyStrips, EndAtTheLargestUnsignedValueWhereItIsNoVertex) {
  const std::vector<std::vector<double>> strips = {{0, 1, 2, 255, 3, 4, 5}};
  EXPECT_EQ(
      testing::MeshOf(StripsOf(PlyFormat::kBinaryBigEndian, strips, kUint8)).value().triangles,
      (std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}}));
  EXPECT_EQ(
      testing::MeshOf(StripsOf(PlyFormat::kBinaryBigEndian, strips, kUint8, 256)).value().triangles,
      (std::vector<Triangle>{{0, 1, 2}, {2, 1, 255}, {2, 255, 3}, {3, 255, 4}, {3, 4, 5}}));
  EXPECT_EQ(testing::MeshOf(StripsOf(PlyFormat::kBinaryLittleEndian,
                                     {{0, 1, 2, 4294967295.0, 3, 4, 5}}, kUint32))
                .value()
                .triangles,
            (std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}}));
}

TEST(PlyStrips, RefuseIndicesThatAreNoVertex) {
  for (const PlyFormat format : kAllFormats) {
    for (const double index : {9.0, -2.0}) {
      const std::string message =
          testing::InputErrorOf(StripsOf(format, {{0, 1, 2}, {0, index, 1}}));
      EXPECT_NE(message.find("tristrips 1: the vertex index"), std::string::npos) << message;
    }
  }
}

TEST(PlyStrips, ComeTogetherWithFacesInTheOrderOfTheFile) {
  const std::string bytes =
      "ply\nformat ascii 1.0\nelement tristrips 1\nproperty list int int vertex_indices\n"
      "element vertex 4\nproperty int x\nproperty int y\nproperty int z\n"
      "element face 1\nproperty list int int vertex_indices\nend_header\n"
      "4 0 1 2 3\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 3 1 0\n";
  EXPECT_EQ(testing::MeshOf(bytes).value().triangles,
            (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {3, 1, 0}}));
}

}  // namespace
}  // namespace folprom::io
