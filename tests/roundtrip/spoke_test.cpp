// Surfaces whose vertices lie on the way from one neighbour to another.
#include <gtest/gtest.h>

#include "tests/support/codec.h"
#include "tests/support/files.h"
#include "tests/support/ply.h"
#include "tests/support/random.h"
#include "tests/support/same_mesh.h"
#include "tests/support/surfaces.h"

namespace folprom::support {
namespace {

/// Returns the bytes; checks that the mesh comes back.
uint64_t CodeLosslessly(const Mesh& mesh, uint32_t subtree_vertices = 1 << 24,
                        uint32_t effort = 5) {
  TemporaryFolder folder;
  const std::string scan = folder.File("scan.ply"), folp = folder.File("scan.folp");
  WritePly(scan, mesh, CoordinateType::kInt);
  EncodeOptions options;
  options.codec = WithEffort(options.codec, effort);
  options.bits = 17;
  options.codec.subtree_vertices = subtree_vertices;
  const EncodeReport report = Encode(scan, folp, options);
  const VerifyReport verified = Verify(folp, scan);
  EXPECT_TRUE(verified.lossless) << verified.reason;
  EXPECT_EQ(DifferenceOf(mesh, LodOf(folp), verified.tolerance), "");
  return report.bytes;
}

TEST(SpokeTest, SubdividedSurfacesComeBackWholeFromSubtrees) {
  CodeLosslessly(SubdividedTerrain(40, 30, 1), 300);
  CodeLosslessly(SubdividedTerrain(40, 30, 2), 1500);
}

TEST(SpokeTest, EveryEffortGivesSubdividedSurfacesBack) {
  for (uint32_t effort = 1; effort <= 9; ++effort) {
    CodeLosslessly(SubdividedTerrain(20, 20, effort), 1 << 24, effort);
  }
}

TEST(SpokeTest, VerticesInTheMiddleOfEdgesMakeFilesSmaller) {
  const Mesh subdivided = SubdividedTerrain(40, 30, 4);
  Mesh beside = subdivided;
  Random random(5);
  for (Point& position : beside.positions) {
    for (double& coordinate : position) coordinate += static_cast<double>(random.Below(100));
  }
  EXPECT_LT(CodeLosslessly(subdivided), CodeLosslessly(beside) * 99 / 100);
}

}  // namespace
}  // namespace folprom::support
