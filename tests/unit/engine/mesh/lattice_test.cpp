#include "engine/mesh/lattice.h"

#include <gtest/gtest.h>

#include <limits>

namespace folprom {
namespace {

TEST(Lattice, TakesAnyCoordinateToAPointOfTheBox) {
  const Lattice lattice{{-1, 0, 5}, 0.25, {8, 4, 0}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const double odd[3][3] = {{nan, -nan, nan}, {-infinity, -1e300, -1e300}, {-1.1, -0.1, 4}};
  for (const auto& xyz : odd) EXPECT_EQ(lattice.FromModel(xyz), (Int3{0, 0, 0}));
  const double beyond[3] = {infinity, 1e300, infinity};
  EXPECT_EQ(lattice.FromModel(beyond), (Int3{8, 4, 0}));
  const double inside[3] = {0, 0.4, 5};
  EXPECT_EQ(lattice.FromModel(inside), (Int3{4, 2, 0}));
}

}  // namespace
}  // namespace folprom
