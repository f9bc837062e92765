#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "tests/support/codec.h"
#include "tests/support/coders.h"
#include "tests/support/files.h"
#include "tests/support/meshes.h"
#include "tests/support/ply.h"
#include "tests/support/same_mesh.h"

namespace folprom::support {
namespace {

constexpr uint32_t kOneSubtree = 1 << 24;

struct Case {
  SmallMesh small;
  uint32_t subtree_vertices;
  Coder coder;
};
void PrintTo(const Case& given, std::ostream* out) {
  *out << given.coder.name << ' ' << given.small.name << " in subtrees of "
       << given.subtree_vertices;
}

class SmallMeshTest : public ::testing::TestWithParam<Case> {
 protected:
  const SmallMesh& small() const { return GetParam().small; }
  EncodeOptions Options() const {
    EncodeOptions options;
    options.codec = GetParam().coder.settings;
    options.bits = small().bits;
    options.codec.subtree_vertices = GetParam().subtree_vertices;
    return options;
  }
};

TEST_P(SmallMeshTest, ComesBackWhole) {
  TemporaryFolder folder;
  std::string scan = folder.File("scan.ply"), folp = folder.File("scan.folp");
  std::string out = folder.File("out.ply");
  WritePly(scan, small().make(), small().type);
  Mesh original = ReadPly(scan).mesh;

  EncodeReport encoded = Encode(scan, folp, Options());
  EXPECT_EQ(encoded.vertices, original.positions.size());
  EXPECT_EQ(encoded.faces, original.faces.size());
  DecodeReport decoded = Decode(folp, out);
  EXPECT_TRUE(decoded.complete);
  EXPECT_EQ(decoded.vertices, original.positions.size());
  EXPECT_EQ(decoded.faces, original.faces.size());

  VerifyReport by_digest = Verify(folp, "");
  EXPECT_TRUE(by_digest.lossless) << by_digest.reason;
  VerifyReport by_scan = Verify(folp, scan);
  EXPECT_TRUE(by_scan.lossless) << by_scan.reason;
  EXPECT_LE(by_scan.max_position_error, by_scan.tolerance * (1 + 1e-9));

  Mesh written = ReadPly(out).mesh;
  EXPECT_EQ(written.positions.size(), original.positions.size());
  EXPECT_EQ(written.faces.size(), original.faces.size());
  if (small().positions_tell) {
    EXPECT_EQ(DifferenceOf(original, written, by_scan.tolerance), "") << "as written to a file";
    EXPECT_EQ(DifferenceOf(original, LodOf(folp), by_scan.tolerance), "") << "as decoded in memory";
  }
  EXPECT_EQ(folder.Names(), (std::vector<std::string>{"out.ply", "scan.folp", "scan.ply"}));
}

/// Every mesh in one subtree and in subtrees of several sizes; thousands of subtrees cost time and
/// prove nothing more.
std::vector<Case> EveryMeshInSubtrees(const Coder& coder) {
  constexpr uint64_t kMostSubtrees = 1200;
  std::vector<Case> cases;
  for (const SmallMesh& small : SmallMeshes()) {
    uint64_t vertices = small.make().positions.size();
    for (uint32_t subtree_vertices : {kOneSubtree, 50u, 7u, 1u}) {
      if (vertices / subtree_vertices <= kMostSubtrees) {
        cases.push_back({small, subtree_vertices, coder});
      }
    }
  }
  return cases;
}

auto NameOfCase = [](const auto& given) {
  const uint32_t vertices = given.param.subtree_vertices;
  return given.param.small.name + "_" +
         (vertices == kOneSubtree ? "All" : std::to_string(vertices));
};
INSTANTIATE_TEST_SUITE_P(InSubtreesOf, SmallMeshTest,
                         ::testing::ValuesIn(EveryMeshInSubtrees({"Quadric", {}})), NameOfCase);
INSTANTIATE_TEST_SUITE_P(LloydInSubtreesOf, SmallMeshTest,
                         ::testing::ValuesIn(EveryMeshInSubtrees({"Lloyd", LloydSettings()})),
                         NameOfCase);

INSTANTIATE_TEST_SUITE_P(LightInSubtreesOf, SmallMeshTest,
                         ::testing::ValuesIn(EveryMeshInSubtrees({"Light", LightSettings()})),
                         NameOfCase);

/// Counts, positions and faces are compared above; that the comparison itself sees faults is proven
/// here.
TEST(MeshComparisonTest, SeesAReversedFace) {
  Mesh a = RandomFaces(30, 60, 1), b = a;
  std::swap(b.faces[7][0], b.faces[7][1]);
  EXPECT_EQ(DifferenceOf(a, a, 1e-6), "");
  EXPECT_NE(DifferenceOf(a, b, 1e-6), "");
}

TEST(MeshComparisonTest, SeesFacesOfCoincidentVerticesExchanged) {
  Mesh a{{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
         {{0, 2, 3}, {0, 3, 4}, {1, 2, 4}}};
  Mesh b = a, c = a;
  b.faces = {{1, 2, 3}, {1, 3, 4}, {0, 2, 4}};  // the two vertices renamed
  c.faces = {{0, 2, 3}, {1, 3, 4}, {1, 2, 4}};
  EXPECT_EQ(DifferenceOf(a, b, 1e-6), "");
  EXPECT_NE(DifferenceOf(a, c, 1e-6), "");
}

TEST(MeshComparisonTest, SeesAVertexTooFarAway) {
  Mesh a = RandomFaces(30, 60, 2), b = a, c = a;
  b.positions[3][1] += 0.9e-3;
  c.positions[3][1] += 1.1e-3;
  EXPECT_EQ(DifferenceOf(a, b, 1e-3), "");
  EXPECT_NE(DifferenceOf(a, c, 1e-3), "");
}

}  // namespace
}  // namespace folprom::support
