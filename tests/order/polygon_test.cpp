// Faces of more than three corners come back as they were.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/order/plain_mesh.h"
#include "tests/order/quads.h"
#include "tests/support/codec.h"
#include "tests/support/files.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace folprom::support {
namespace {

EncodeOptions Exact(bool keep_order, uint32_t subtree_vertices = 60) {
  EncodeOptions options;
  options.exact = true;
  options.keep_order = keep_order;
  options.codec.subtree_vertices = subtree_vertices;
  return options;
}

std::string OffText(const std::vector<std::string>& vertices, const Faces& faces) {
  std::string text =
      "OFF\n" + std::to_string(vertices.size()) + " " + std::to_string(faces.size()) + " 0\n";
  for (const std::string& vertex : vertices) text += vertex + "\n";
  for (const auto& face : faces) {
    text += std::to_string(face.size());
    for (const int64_t corner : face) text.append(" ").append(std::to_string(corner));
    text += "\n";
  }
  return text;
}

std::vector<std::string> GridVertices(int64_t side) {
  std::vector<std::string> vertices;
  for (int64_t i = 0; i < side * side; ++i) {
    vertices.push_back(std::to_string(i % side) + " " + std::to_string(i / side) + " " +
                       std::to_string(i * i % 7));
  }
  return vertices;
}

/// Whatever a file may say is a face: any size, repeated corners and edges, copies, both ways
/// round.
Faces WildFaces(int64_t vertices, uint64_t seed) {
  Random random(seed);
  Faces faces;
  for (int i = 0; i < 150; ++i) {
    std::vector<int64_t> face(3 + random.Below(random.Below(10) == 0 ? 40 : 5));
    for (int64_t& corner : face) {
      corner = static_cast<int64_t>(random.Below(static_cast<uint64_t>(vertices)));
    }
    if (random.Below(6) == 0) face[1] = face[0];
    if (random.Below(6) == 0) face.back() = face[1];
    faces.push_back(face);
    if (random.Below(4) == 0) faces.push_back(face);
    if (random.Below(6) == 0) faces.emplace_back(face.rbegin(), face.rend());
  }
  faces.push_back({0, 0, 0, 0, 0});
  faces.push_back({1, 2, 1, 2, 1, 2});
  return faces;
}

/// Encodes, decodes and compares in the order of the scan.
void ExpectInOrder(const std::string& scan, const TemporaryFolder& folder) {
  EncodeOptions options = Exact(true);
  options.overwrite = true;
  Encode(scan, folder.File("scan.folp"), options);
  DecodeOptions force;
  force.overwrite = true;
  for (const char* name : {"back.ply", "back.obj", "back.off"}) {
    Decode(folder.File("scan.folp"), folder.File(name), force);
    const PlainMesh back = ReadPlain(folder.File(name)), wanted = ReadPlain(scan);
    EXPECT_TRUE(back.vertices == wanted.vertices) << name;
    EXPECT_TRUE(back.faces == wanted.faces) << name;
  }
  const VerifyReport verified = Verify(folder.File("scan.folp"), scan);
  EXPECT_TRUE(verified.lossless) << verified.reason;
}

/// The same without an order; the vertices tell each other apart.
void ExpectAsSet(const std::string& scan, const TemporaryFolder& folder) {
  EncodeOptions options = Exact(false);
  options.overwrite = true;
  Encode(scan, folder.File("scan.folp"), options);
  DecodeOptions force;
  force.overwrite = true;
  Decode(folder.File("scan.folp"), folder.File("back.ply"), force);
  PlainMesh back = ReadPlain(folder.File("back.ply"));
  const PlainMesh wanted = ReadPlain(scan);
  for (auto& face : back.faces) {
    for (int64_t& corner : face) {
      const auto same = std::find(wanted.vertices.begin(), wanted.vertices.end(),
                                  back.vertices[static_cast<size_t>(corner)]);
      corner = same - wanted.vertices.begin();
    }
  }
  EXPECT_TRUE(FacesAsSet(back.faces) == FacesAsSet(wanted.faces));
  const VerifyReport verified = Verify(folder.File("scan.folp"), scan);
  EXPECT_TRUE(verified.lossless) << verified.reason;
  EXPECT_TRUE(Verify(folder.File("scan.folp"), "").lossless);
}

TEST(Polygons, OfAnyKindComeBack) {
  for (uint64_t seed = 1; seed < 6; ++seed) {
    const TemporaryFolder folder;
    WriteBytes(folder.File("scan.off"), OffText(GridVertices(12), WildFaces(144, seed)));
    ExpectInOrder(folder.File("scan.off"), folder);
    ExpectAsSet(folder.File("scan.off"), folder);
  }
}

TEST(Polygons, MixedWithTrianglesComeBack) {
  Faces faces = Quads(15);
  Random random(4);
  for (size_t i = 0; i < faces.size(); ++i) {
    if (random.Below(3) == 0) faces[i].pop_back();
    std::swap(faces[i], faces[random.Below(i + 1)]);
  }
  const TemporaryFolder folder;
  WriteBytes(folder.File("scan.off"), OffText(GridVertices(15), faces));
  ExpectInOrder(folder.File("scan.off"), folder);
  ExpectAsSet(folder.File("scan.off"), folder);
}

TEST(Polygons, OfMoreCornersThanAByteCountsComeBack) {
  std::vector<int64_t> large(1000);
  for (size_t i = 0; i < large.size(); ++i) large[i] = static_cast<int64_t>(i);
  Faces faces = Quads(32);
  faces.push_back(large);
  const TemporaryFolder folder;
  WriteBytes(folder.File("scan.off"), OffText(GridVertices(32), faces));
  ExpectInOrder(folder.File("scan.off"), folder);
  ExpectAsSet(folder.File("scan.off"), folder);
}

TEST(Polygons, OfAQuadMeshTakeLessThanABitAFace) {
  const TemporaryFolder folder;
  WriteBytes(folder.File("scan.off"), OffText(GridVertices(60), Quads(60)));
  const EncodeReport report =
      Encode(folder.File("scan.off"), folder.File("scan.folp"), Exact(false, 4000));
  EXPECT_LT(8 * report.polygon_bytes, 59 * 59);
  EXPECT_TRUE(report.warnings.empty());
}

TEST(Polygons, AreTrianglesInStlAndInLevelsOfDetail) {
  const TemporaryFolder folder;
  WriteBytes(folder.File("scan.off"), OffText(GridVertices(12), Quads(12)));
  Encode(folder.File("scan.off"), folder.File("scan.folp"), Exact(false));
  const DecodeReport report = Decode(folder.File("scan.folp"), folder.File("back.stl"));
  EXPECT_EQ(ReadPlain(folder.File("back.stl")).faces.size(), 2u * 11 * 11);
  EXPECT_TRUE(std::ranges::any_of(report.warnings, [](const std::string& warning) {
    return warning.find("STL holds triangles alone") != std::string::npos;
  }));
  DecodeOptions coarse;
  coarse.layers = 2;
  Decode(folder.File("scan.folp"), folder.File("coarse.ply"), coarse);
  for (const auto& face : ReadPlain(folder.File("coarse.ply")).faces) EXPECT_EQ(face.size(), 3u);
}

TEST(Polygons, AreKnownToTheMemoryDecoder) {
  const TemporaryFolder folder;
  const Faces faces = Quads(12);
  WriteBytes(folder.File("scan.off"), OffText(GridVertices(12), faces));
  Encode(folder.File("scan.off"), folder.File("scan.folp"), Exact(true));
  const Mesh mesh = LodOf(folder.File("scan.folp"));
  ASSERT_EQ(mesh.polygon_begin.size(), faces.size());
  for (size_t f = 0; f < faces.size(); ++f) {
    const auto& first = mesh.faces[mesh.polygon_begin[f]];
    const auto& second = mesh.faces[mesh.polygon_begin[f] + 1];
    const std::vector<int64_t> corners = {
        static_cast<int64_t>(first[0]), static_cast<int64_t>(first[1]),
        static_cast<int64_t>(first[2]), static_cast<int64_t>(second[2])};
    EXPECT_EQ(corners, faces[f]);
  }
}

}  // namespace
}  // namespace folprom::support
