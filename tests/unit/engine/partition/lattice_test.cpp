#include "engine/mesh/lattice.h"

#include <gtest/gtest.h>

namespace folprom {
namespace {

Int3 FromModel(const Lattice& lattice, double x, double y, double z) {
  const double xyz[3] = {x, y, z};
  return lattice.FromModel(xyz);
}

TEST(Lattice, RoundsToTheNearestPoint) {
  Lattice lattice;
  lattice.origin = {-1, 0, 10};
  lattice.unit = 0.5;
  lattice.extent = {100, 100, 100};
  EXPECT_EQ(FromModel(lattice, -1, 0.24, 10.26), (Int3{0, 0, 1}));
  EXPECT_EQ(FromModel(lattice, 0, 0.25, 59.9), (Int3{2, 1, 100}));
}

TEST(Lattice, DoesNotRoundUpJustBelowTheMiddle) {
  Lattice lattice;
  lattice.extent = {1, 1, 1};
  EXPECT_EQ(FromModel(lattice, 0.49999999999999994, 0.5, 0), (Int3{0, 1, 0}));
}

TEST(Lattice, ClampsToTheBox) {
  Lattice lattice;
  lattice.extent = {7, (1 << 30) - 1, 0};
  EXPECT_EQ(FromModel(lattice, -1e300, 1e300, 5), (Int3{0, (1 << 30) - 1, 0}));
}

TEST(Lattice, GivesItsOwnPointsBack) {
  Lattice lattice;
  lattice.origin = {0.1, -7.3, 1e6};
  lattice.unit = 1.0 / 3;
  lattice.extent = {1 << 29, 1 << 29, 1 << 29};
  for (int32_t k = 0; k < 1 << 29; k = 3 * k + 1) {
    EXPECT_EQ(
        FromModel(lattice, lattice.ToModel(0, k), lattice.ToModel(1, k), lattice.ToModel(2, k)),
        (Int3{k, k, k}));
  }
}

TEST(Bounds, MeasuresSideAndDiagonal) {
  const Bounds box{{0, 1, 2}, {2, 4, 8}};
  EXPECT_EQ(box.longest(), 6);
  EXPECT_EQ(box.diagonal(), 7);
  EXPECT_EQ(Bounds{}.longest(), 0);
  EXPECT_EQ(Bounds{}.diagonal(), 0);
}

}  // namespace
}  // namespace folprom
