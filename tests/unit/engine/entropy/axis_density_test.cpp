#include "engine/entropy/axis_density.h"

#include <gtest/gtest.h>

#include <random>

namespace folprom {
namespace {

void ExpectDistribution(const AxisDensity& density, double lo, double hi) {
  const double side = hi - lo;
  EXPECT_EQ(density.Below(lo - side - 1), 0);
  EXPECT_NEAR(density.Below(hi + side + 1), 1, 1e-5);
  double before = 0;
  for (int i = -50; i <= 1050; ++i) {
    const double now = density.Below(lo + side * i / 1000);
    ASSERT_GE(now, before) << i;
    ASSERT_LE(now, 1);
    before = now;
  }
}

TEST(AxisDensity, RisesFromZeroToOne) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> part(-0.5, 1.5);
  for (double lo : {-1e9, -3.0, 0.0, 1e6}) {
    for (double side : {1e-3, 1.0, 1e3, 2e9}) {
      AxisDensity density;
      density.Start(lo, lo + side);
      for (int i = 0; i < 30; ++i) {
        const double half = side * 0.1 * (part(random) + 0.5);
        density.Add(lo + side * part(random), half, part(random) + 0.5);
      }
      density.Finish();
      ExpectDistribution(density, lo, lo + side);
    }
  }
}

TEST(AxisDensity, IsUniformWithoutMass) {
  AxisDensity density;
  density.Start(-10, 30);
  density.Finish();
  for (double x = -10; x <= 30; x += 0.5) EXPECT_NEAR(density.Below(x), (x + 10) / 40, 1e-5);
}

TEST(AxisDensity, PutsTheMassWhereTheTentsAre) {
  AxisDensity density;
  density.Start(0, 64);
  density.Add(16, 4, 3);
  density.Add(48, 4, 1);
  density.Finish();
  EXPECT_NEAR(density.Below(10), 0, 0.01);
  EXPECT_NEAR(density.Below(16), 0.375, 0.01);
  EXPECT_NEAR(density.Below(32), 0.75, 0.01);
  EXPECT_NEAR(density.Below(54), 1, 0.01);
  // Nothing is impossible.
  EXPECT_GT(density.Below(36), density.Below(32));
}

TEST(AxisDensity, KeepsTheMassOfTentsOutsideAtItsEnds) {
  AxisDensity density;
  density.Start(0, 1);
  density.Add(-1e9, 0.1, 1);
  density.Add(1e9, 0.1, 1);
  density.Finish();
  ExpectDistribution(density, 0, 1);
  EXPECT_NEAR(density.Below(0.5), 0.5, 0.01);
}

TEST(AxisDensity, EmptyIntervalAndReuseAreFine) {
  AxisDensity density;
  density.Start(5, 5);
  density.Add(5, 0, 1);
  density.Finish();
  ExpectDistribution(density, 5, 5 + 1e-9);
  density.Start(0, 1);
  density.Finish();
  EXPECT_NEAR(density.Below(0.5), 0.5, 1e-6) << "nothing is left of what was";
}

}  // namespace
}  // namespace folprom
