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

/// One box.
void Add(AxisDensity* density, float middle, float mass) {
  density->Add(Lanes{middle, 0, 0, 0}, Lanes{mass, 0, 0, 0});
}

TEST(AxisDensity, RisesFromZeroToOne) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<float> part(0, 1);
  for (double lo : {-1e6, -3.0, 0.0, 1e6}) {
    for (double side : {1e-3, 1.0, 1e3, 2e9}) {
      for (double half : {0.0, 0.01, 0.1, 10.0}) {
        AxisDensity density;
        density.Start(lo, lo + side, side * half);
        for (int i = 0; i < 30; ++i) {
          const Lanes middle = static_cast<float>(lo) +
                               static_cast<float>(side) * Lanes{part(random), part(random), 0, 1};
          density.Add(middle, Lanes{part(random), part(random), part(random), part(random)});
        }
        density.Finish();
        ExpectDistribution(density, lo - 1.5 * half * side, lo + side * (1 + 1.5 * half));
      }
    }
  }
}

TEST(AxisDensity, IsUniformWithoutMass) {
  AxisDensity density;
  density.Start(-10, 30, 0);
  density.Finish();
  for (double x = -10; x <= 30; x += 0.5) EXPECT_NEAR(density.Below(x), (x + 10) / 40, 1e-5);
}

TEST(AxisDensity, PutsTheMassWhereTheBoxesAre) {
  AxisDensity density;
  density.Start(16, 48, 4);
  Add(&density, 16, 3);
  Add(&density, 48, 1);
  density.Finish();
  EXPECT_NEAR(density.Below(12), 0, 0.01);
  EXPECT_NEAR(density.Below(16), 0.375, 0.01);
  EXPECT_NEAR(density.Below(17.5), 0.375 * 1.5, 0.02);
  EXPECT_NEAR(density.Below(32), 0.75, 0.01);
  EXPECT_NEAR(density.Below(52), 1, 0.01);
  // Nothing is impossible.
  EXPECT_GT(density.Below(36), density.Below(32));
}

TEST(AxisDensity, KeepsTheMassOfBoxesOutsideAtItsEnds) {
  AxisDensity density;
  density.Start(0, 1, 0);
  density.Add(Lanes{-1e9F, 1e9F, 0.5F, 0.5F}, Lanes{1, 1, 0, 0});
  density.Finish();
  ExpectDistribution(density, 0, 1);
  EXPECT_NEAR(density.Below(0.5), 0.5, 0.01);
}

TEST(AxisDensity, EmptyIntervalAndReuseAreFine) {
  AxisDensity density;
  density.Start(5, 5, 0);
  Add(&density, 5, 1);
  density.Finish();
  ExpectDistribution(density, 5, 5 + 1e-9);
  density.Start(0, 1, 0);
  density.Finish();
  EXPECT_NEAR(density.Below(0.5), 0.5, 1e-6) << "nothing is left of what was";
}

}  // namespace
}  // namespace folprom
