#include "engine/entropy/online_regression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace folprom {
namespace {

TEST(OnlineRegression, StartsFromTheGivenWeights) {
  OnlineRegression<3> fit({2, -1, 0.5});
  EXPECT_EQ(fit.Predict({1, 1, 1}), 1.5);
  EXPECT_EQ(fit.Predict({0, 4, 0}), -4);
}

TEST(OnlineRegression, LearnsKnownWeights) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> draw(0, 1);
  OnlineRegression<3> fit({2, 0, 0});
  for (int i = 0; i < 3200; ++i) {
    const std::array<double, 3> x{draw(random), draw(random), draw(random)};
    fit.Learn(x, 0.5 * x[0] - 3 * x[1] + 7 * x[2] + 0.1 * draw(random));
  }
  EXPECT_NEAR(fit.Predict({1, 0, 0}), 0.5, 0.03);
  EXPECT_NEAR(fit.Predict({0, 1, 0}), -3, 0.03);
  EXPECT_NEAR(fit.Predict({0, 0, 1}), 7, 0.03);
}

TEST(OnlineRegression, ForgetsWhatNoLongerHolds) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> draw(0, 1);
  OnlineRegression<1> fit({0});
  for (int i = 0; i < 100000; ++i) {
    const double x = draw(random);
    fit.Learn({x}, i < 20000 ? -x : x);
  }
  EXPECT_NEAR(fit.Predict({1}), 1, 0.02);
}

TEST(OnlineRegression, HoldsTheFirstWeightsWhereSamplesSayNothing) {
  OnlineRegression<2> fit({2, -1});
  for (int i = 0; i < 1000; ++i) fit.Learn({0, 0}, 5);
  EXPECT_EQ(fit.Predict({1, 0}), 2);
  EXPECT_EQ(fit.Predict({0, 1}), -1);
}

TEST(OnlineRegression, EqualFeaturesAndLargeTargetsStayFinite) {
  OnlineRegression<5> fit({2, 0, 0, 0, 0});
  for (int i = 0; i < 10000; ++i) {
    const double x = i % 3 == 0 ? 0 : 1;
    fit.Learn({x, x, x, x, x}, i % 2 == 0 ? 1e9 : -1e9);
    ASSERT_TRUE(std::isfinite(fit.Predict({1, 1, 1, 1, 1})));
  }
}

TEST(OnlineRegression, KeepsItsWeightsWhereRoundingHidesTheRidge) {
  OnlineRegression<5> fit({2, 0, 0, 0, 0});
  for (int i = 0; i < 10000; ++i) {
    const double x = 268435456.0 + i % 2;
    fit.Learn({0, 0, 0, x, i % 5 == 0 ? x * 2 / 3 : x}, 1);
    ASSERT_TRUE(std::isfinite(fit.Predict({1, 1, 1, 1, 1})));
  }
}

}  // namespace
}  // namespace folprom
