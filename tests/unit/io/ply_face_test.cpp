#include <gtest/gtest.h>

#include "ply_builder.h"
#include "support.h"

namespace folprom::io {
namespace {

using enum ScalarType;
using testing::InputErrorOf;
using testing::kAllFormats;
using testing::PlyBuilder;
using testing::TypeName;

constexpr ScalarType kIntegers[] = {kInt8, kUint8, kInt16, kUint16, kInt32, kUint32};

PlyBuilder SixPoints(PlyFormat format) {
  PlyBuilder ply(format);
  ply.Header("element vertex 6");
  for (const char* axis : {"x", "y", "z"}) ply.Header(std::string("property char ") + axis);
  return ply;
}

void AddPoints(PlyBuilder& ply) {
  for (int v = 0; v < 6; ++v) ply.Value(kInt8, v).Value(kInt8, 0).Value(kInt8, -v).End();
}

std::string FacesOf(PlyFormat format, const std::vector<std::vector<double>>& faces,
                    ScalarType count_type = kUint8, ScalarType type = kInt32,
                    const std::string& name = "vertex_indices") {
  PlyBuilder ply = SixPoints(format);
  ply.Header("element face " + std::to_string(faces.size()));
  ply.Header("property list " + TypeName(count_type, true) + " " + TypeName(type, false) + " " +
             name);
  ply.Body();
  AddPoints(ply);
  for (const auto& face : faces) ply.List(count_type, type, face).End();
  return ply.bytes();
}

TEST(PlyFaces, TakeIndicesAndCountsOfEveryIntegerType) {
  for (const PlyFormat format : kAllFormats) {
    for (const ScalarType count_type : kIntegers) {
      for (const ScalarType type : kIntegers) {
        const auto mesh = testing::MeshOf(FacesOf(format, {{0, 1, 2}, {5, 4, 3}, {1, 2, 3, 4}},
                                                  count_type, type, "vertex_index"))
                              .value();
        EXPECT_EQ(mesh.triangles,
                  (std::vector<Triangle>{{0, 1, 2}, {5, 4, 3}, {1, 2, 3}, {1, 3, 4}}));
      }
    }
  }
}

TEST(PlyFaces, KeepDegenerateAndDuplicateTrianglesInTheirOrder) {
  for (const PlyFormat format : kAllFormats) {
    const std::string bytes = FacesOf(format, {{1, 1, 2}, {0, 1, 2}, {0, 1, 2}, {3, 3, 3}});
    EXPECT_EQ(testing::MeshOf(bytes).value().triangles,
              (std::vector<Triangle>{{1, 1, 2}, {0, 1, 2}, {0, 1, 2}, {3, 3, 3}}));
  }
}

TEST(PlyFaces, SplitPolygonsAsFansAndDropThoseOfFewerThanThreeCorners) {
  for (const PlyFormat format : kAllFormats) {
    const testing::TemporaryFolder folder;
    const auto source =
        testing::OpenBytes(
            folder,
            FacesOf(format, {{}, {4}, {5, 4, 3, 2, 1}, {0, 1}, {0, 1, 2}, {0, 2, 4, 5}, {}}))
            .value();
    EXPECT_EQ(
        testing::AllBlocks(*source).value().triangles,
        (std::vector<Triangle>{{5, 4, 3}, {5, 3, 2}, {5, 2, 1}, {0, 1, 2}, {0, 2, 4}, {0, 4, 5}}));
    EXPECT_EQ(source->notes().polygons_triangulated, 2u);
    EXPECT_EQ(source->notes().polygons_dropped, 4u);
  }
}

TEST(PlyFaces, MayComeBeforeTheirVertices) {
  for (const PlyFormat format : kAllFormats) {
    PlyBuilder ply(format);
    ply.Header("element face 1").Header("property list uchar int vertex_indices");
    ply.Header("element vertex 3").Header("property float x").Header("property float y");
    ply.Header("property float z").Body();
    ply.List(kUint8, kInt32, {2, 1, 0}).End();
    for (int v = 0; v < 3; ++v) ply.Value(kFloat32, v).Value(kFloat32, 1).Value(kFloat32, 2).End();
    EXPECT_EQ(testing::MeshOf(ply.bytes()).value().triangles, (std::vector<Triangle>{{2, 1, 0}}));
    EXPECT_EQ(testing::MeshOf(ply.bytes()).value().xyz,
              (std::vector<double>{0, 1, 2, 1, 1, 2, 2, 1, 2}));
  }
}

TEST(PlyFaces, WithPropertiesAroundTheListKeepTheirIndices) {
  for (const PlyFormat format : kAllFormats) {
    for (const bool second_list : {false, true}) {
      PlyBuilder ply = SixPoints(format);
      ply.Header("element face 40").Header("property double before");
      ply.Header("property list uchar ushort vertex_indices").Header("property short after");
      if (second_list) ply.Header("property list uint float texcoord");
      ply.Body();
      AddPoints(ply);
      std::vector<Triangle> expected;
      for (uint64_t f = 0; f < 40; ++f) {
        ply.Value(kFloat64, 0.5);
        if (f % 7 == 3) {
          ply.List(kUint8, kUint16, {0, 1, 2, 3});
          expected.insert(expected.end(), {{0, 1, 2}, {0, 2, 3}});
        } else {
          ply.List(kUint8, kUint16, {double(f % 6), double((f + 1) % 6), 3});
          expected.push_back({f % 6, (f + 1) % 6, 3});
        }
        ply.Value(kInt16, 3);
        if (second_list) ply.List(kUint32, kFloat32, std::vector<double>(f % 3, 0.25));
        ply.End();
      }
      EXPECT_EQ(testing::MeshOf(ply.bytes()).value().triangles, expected);
    }
  }
}

TEST(PlyFaces, NameTheFaceOfAnIndexThatIsNoVertex) {
  for (const PlyFormat format : kAllFormats) {
    for (const double index : {6.0, -1.0, 2147483647.0, -2147483648.0}) {
      for (const auto& face : {std::vector<double>{0, 1, index}, {0, 1, 2, 3, index}}) {
        const std::string message = InputErrorOf(FacesOf(format, {{0, 1, 2}, face}));
        EXPECT_NE(
            message.find("face 1: the vertex index " + std::to_string(static_cast<int64_t>(index))),
            std::string::npos)
            << message;
      }
    }
  }
  EXPECT_NE(
      InputErrorOf(FacesOf(PlyFormat::kBinaryLittleEndian, {{0, 1, 4294967295.0}}, kUint8, kUint32))
          .find("4294967295"),
      std::string::npos);
}

TEST(PlyFaces, RefuseNegativeCounts) {
  for (const PlyFormat format : kAllFormats) {
    PlyBuilder ply = SixPoints(format);
    ply.Header("element face 1").Header("property list int int vertex_indices").Body();
    AddPoints(ply);
    ply.Value(kInt32, -3).Value(kInt32, 0).End();
    EXPECT_NE(InputErrorOf(ply.bytes()).find("negative count -3"), std::string::npos);
  }
}

TEST(PlyFaces, RefuseCountsBeyondTheFile) {
  for (const PlyFormat format : kAllFormats) {
    PlyBuilder ply = SixPoints(format);
    ply.Header("element face 1").Header("property list uint double other");
    ply.Header("property list uchar int vertex_indices").Body();
    AddPoints(ply);
    ply.Value(kUint32, 4294967295.0).Value(kUint8, 0).Value(kUint8, 0).Value(kUint8, 0).End();
    EXPECT_NE(InputErrorOf(ply.bytes()).find("face 0"), std::string::npos);
  }
}

TEST(PlyFaces, OfTextNameTheirLine) {
  const std::string message = InputErrorOf(FacesOf(PlyFormat::kAscii, {{0, 1, 2}}) + "4 0 1 2\n");
  EXPECT_EQ(message, "");  // what follows the last record is not read
  std::string bytes = FacesOf(PlyFormat::kAscii, {{0, 1, 2}, {0, 1, 2}});
  bytes.replace(bytes.rfind("3 0"), 3, "4 0");
  EXPECT_NE(InputErrorOf(bytes).find("face 1: line 17: the line has fewer values"),
            std::string::npos)
      << InputErrorOf(bytes);
}

}  // namespace
}  // namespace folprom::io
