// Surfaces whose vertices lie on the way from one neighbour to another.
#include <gtest/gtest.h>

#include "tests/support/lossless.h"
#include "tests/support/random.h"
#include "tests/support/surfaces.h"

namespace folprom::support {
namespace {

EncodeOptions Options(uint32_t subtree_vertices = 1 << 24, uint32_t effort = 5) {
  EncodeOptions options;
  options.codec = WithEffort(options.codec, effort);
  options.bits = 17;
  options.codec.subtree_vertices = subtree_vertices;
  return options;
}

TEST(SpokeTest, SubdividedSurfacesComeBackWholeFromSubtrees) {
  CodeLosslessly(SubdividedTerrain(40, 30, 1), Options(300));
  CodeLosslessly(SubdividedTerrain(40, 30, 2), Options(1500));
}

TEST(SpokeTest, EveryEffortGivesSubdividedSurfacesBack) {
  for (uint32_t effort = 1; effort <= 9; ++effort) {
    CodeLosslessly(SubdividedTerrain(20, 20, effort), Options(1 << 24, effort));
  }
}

TEST(SpokeTest, VerticesInTheMiddleOfEdgesMakeFilesSmaller) {
  const Mesh subdivided = SubdividedTerrain(40, 30, 4);
  Mesh beside = subdivided;
  Random random(5);
  for (Point& position : beside.positions) {
    for (double& coordinate : position) coordinate += static_cast<double>(random.Below(100));
  }
  EXPECT_LT(CodeLosslessly(subdivided, Options()), CodeLosslessly(beside, Options()) * 99 / 100);
}

}  // namespace
}  // namespace folprom::support
