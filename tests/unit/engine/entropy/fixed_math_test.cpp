#include "engine/entropy/fixed_math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace folprom {
namespace {

TEST(FixedMath, ExponentialIsThatOfTheLibrary) {
  for (double x = -39.99; x < 40; x += 0.0137) {
    const double expected = std::exp(x);
    EXPECT_NEAR(ExpExact(x) / expected, 1, 1e-12) << x;
  }
  EXPECT_EQ(ExpExact(0), 1);
}

TEST(FixedMath, LogarithmIsThatOfTheLibrary) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-300, 300);
  for (int i = 0; i < 20000; ++i) {
    const double x = std::exp2(exponent(random));
    EXPECT_NEAR(Log2Exact(x), std::log2(x), 1e-12 * std::max(1.0, std::fabs(std::log2(x)))) << x;
  }
  for (int k = -60; k < 60; ++k) EXPECT_EQ(Log2Exact(std::ldexp(1.0, k)), k);
  for (double x : {0.9999999999, 1.0000000001, 1.999999999999, 0.5000000001}) {
    EXPECT_NEAR(Log2Exact(x), std::log2(x), 1e-12) << x;
  }
}

TEST(FixedMath, SineAndCosineAreThoseOfTheLibrary) {
  auto check = [](double angle) {
    double sine, cosine;
    SinCos(angle, &sine, &cosine);
    ASSERT_NEAR(sine, std::sin(angle), 1e-12) << angle;
    ASSERT_NEAR(cosine, std::cos(angle), 1e-12) << angle;
  };
  for (double angle = -99.9; angle < 100; angle += 0.00713) check(angle);
  for (int quarter = -60; quarter <= 60; ++quarter) {
    for (double off : {-1e-9, 0.0, 1e-9}) check(quarter * kPi / 4 + off);
  }
}

TEST(FixedMath, AngleIsThatOfTheLibrary) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 100000; ++i) {
    const double scale = std::ldexp(1.0, static_cast<int>(random() % 60) - 30);
    const double x = normal(random) * scale, y = normal(random) * scale;
    double expected = std::atan2(y, x);
    if (expected < 0) expected += 2 * kPi;
    const double angle = Angle(x, y);
    ASSERT_NEAR(angle, expected, 1e-12) << x << " " << y;
    ASSERT_GE(angle, 0);
    ASSERT_LT(angle, 2 * kPi);
  }
}

TEST(FixedMath, AngleHoldsOnTheAxesAndBesideThem) {
  const struct {
    double x, y, angle;
  } cases[] = {{0, 0, 0},          {1, 0, 0},          {5, 5, kPi / 4},
               {0, 2, kPi / 2},    {-3, 0, kPi},       {-1, -1, 1.25 * kPi},
               {0, -7, 1.5 * kPi}, {4, -4, 1.75 * kPi}};
  for (const auto& c : cases) EXPECT_NEAR(Angle(c.x, c.y), c.angle, 1e-14) << c.x << " " << c.y;
  for (double tiny : {1e-3, 1e-9, 1e-15, 1e-200}) {
    for (double y : {tiny, -tiny}) {
      for (double x : {1.0, -1.0}) {
        double expected = std::atan2(y, x);
        if (expected < 0) expected += 2 * kPi;
        const double angle = Angle(x, y);
        // Next to the full turn both ends of the range are right.
        const double off = std::fabs(angle - expected);
        EXPECT_LT(std::min(off, 2 * kPi - off), 1e-12) << x << " " << y;
        EXPECT_GE(angle, 0);
        EXPECT_LT(angle, 2 * kPi);
      }
    }
  }
}

TEST(FixedMath, HalfOctaveIsTwiceTheLogarithmUpToTheRoundingOfRootTwo) {
  EXPECT_EQ(HalfOctave(0), 0);
  EXPECT_EQ(HalfOctave(1), 0);
  int before = 0;
  for (uint64_t value = 1; value < 100000; ++value) {
    const int octave = HalfOctave(value);
    const double exact = 2 * std::log2(static_cast<double>(value));
    EXPECT_GE(octave, before);
    EXPECT_GT(octave, exact - 1.02);
    EXPECT_LT(octave, exact + 0.02);
    before = octave;
  }
  EXPECT_EQ(HalfOctave(~uint64_t{0}), 127);
}

}  // namespace
}  // namespace folprom
