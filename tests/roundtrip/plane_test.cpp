// Surfaces whose vertices share coordinates: cut out of voxels, or with flat sides.
#include <gtest/gtest.h>

#include "tests/support/bit_mesh.h"
#include "tests/support/lossless.h"
#include "tests/support/random.h"
#include "tests/support/surfaces.h"

namespace folprom::support {
namespace {

EncodeOptions Bits(uint32_t bits, uint32_t subtree_vertices = 1 << 24) {
  EncodeOptions options;
  options.bits = bits;
  options.codec.subtree_vertices = subtree_vertices;
  return options;
}

class PlanesTest : public ::testing::TestWithParam<uint32_t> {};
INSTANTIATE_TEST_SUITE_P(SubtreeOf, PlanesTest, ::testing::Values(300u, 1500u, 1u << 24));

TEST_P(PlanesTest, SurfaceOfVoxelsComesBackWhole) {
  CodeLosslessly(VoxelTerrain(60, 50, 1), Bits(17, GetParam()));
}

TEST_P(PlanesTest, SurfaceOfVoxelsComesBackWholeExactly) {
  CodeLosslessly(VoxelTerrain(60, 50, 2), ExactOptions(GetParam()));
}

TEST_P(PlanesTest, SurfaceOfVoxelsComesBackWholeInOrder) {
  EncodeOptions options = ExactOptions(GetParam());
  options.keep_order = true;
  CodeLosslessly(VoxelTerrain(40, 30, 3), options);
}

TEST(PlaneTest, EveryEffortGivesSurfacesOfVoxelsBack) {
  for (uint32_t effort = 1; effort <= 9; ++effort) {
    EncodeOptions options = Bits(17);
    options.codec = WithEffort(options.codec, effort);
    CodeLosslessly(VoxelTerrain(40, 40, effort), options);
  }
}

TEST(PlaneTest, SharedCoordinatesMakeFilesSmaller) {
  const Mesh on_planes = VoxelTerrain(90, 70, 4);
  Mesh beside = on_planes;
  Random random(5);
  for (Point& position : beside.positions) {
    for (double& coordinate : position) coordinate += static_cast<double>(random.Below(100));
  }
  EXPECT_LT(CodeLosslessly(on_planes, Bits(17)), CodeLosslessly(beside, Bits(17)) * 9 / 10);
  EXPECT_LT(CodeLosslessly(on_planes, ExactOptions()),
            CodeLosslessly(beside, ExactOptions()) * 9 / 10);
}

}  // namespace
}  // namespace folprom::support
