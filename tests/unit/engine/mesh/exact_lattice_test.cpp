#include "engine/mesh/exact_lattice.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

#include "folprom/float_bits.h"

namespace folprom {
namespace {

constexpr int32_t kExtent = (1 << 30) - 2;

uint64_t BitsOf(double x) { return std::bit_cast<uint64_t>(x); }

ExactLattice LatticeOf(uint32_t radix, int32_t exponent, bool is_float, int64_t first) {
  return {{radix, exponent, is_float, true}, {first, first, first}};
}

void ExpectBack(const ExactLattice& lattice, double x) {
  const ExactLattice::Coordinate split = lattice.Split(1, kExtent, x);
  ASSERT_GE(split.k, 0);
  ASSERT_LE(split.k, kExtent);
  ASSERT_EQ(BitsOf(lattice.Join(1, split.k, split.rest)), BitsOf(x)) << x;
  if (split.rest.digits == CoordinateRest::kRaw) return;
  ASSERT_LE(split.rest.digits, lattice.step.MostDigits(lattice.first[1] + split.k)) << x;
}

TEST(ExactLattice, GivesEveryBitBack) {
  std::mt19937_64 random(1);
  for (bool is_float : {true, false}) {
    for (int i = 0; i < 20000; ++i) {
      const int32_t decimals = static_cast<int32_t>(random() % 23);
      const int32_t bits = static_cast<int32_t>(random() % 1201) - 126;
      const auto first = static_cast<int64_t>(random()) >> (14 + random() % 50);
      double x = std::bit_cast<double>(random());
      if (i % 2 == 0)
        x = std::ldexp(static_cast<double>(random() % 100000),
                       static_cast<int>(random() % 40) - 30);
      if (i % 3 == 0) x = static_cast<double>(random() % 100000) / 1e4;
      if (is_float) x = WidenFloat(std::bit_cast<float>(NarrowToFloatBits(x)));
      ExpectBack(LatticeOf(10, decimals, is_float, first), x);
      ExpectBack(LatticeOf(2, bits, is_float, first), x);
    }
  }
}

TEST(ExactLattice, LeavesNoRestOfWhatLiesOnIt) {
  for (bool is_float : {true, false}) {
    for (int32_t k = -1000; k < 1000; ++k) {
      const double decimal = is_float ? static_cast<double>(static_cast<float>(k / 1e3)) : k / 1e3;
      const auto on = LatticeOf(10, 3, is_float, -5000).Split(0, kExtent, decimal);
      EXPECT_EQ(on.k, k + 5000);
      EXPECT_EQ(on.rest, CoordinateRest{});
      const auto binary = LatticeOf(2, 9, is_float, -5000).Split(0, kExtent, k / 512.0);
      EXPECT_EQ(binary.k, k + 5000);
      EXPECT_EQ(binary.rest, CoordinateRest{});
    }
  }
}

TEST(ExactLattice, LeavesTheFurtherDigits) {
  const auto decimal = LatticeOf(10, 2, false, -1000).Split(0, kExtent, -1.2345);
  EXPECT_EQ(decimal.k, 1000 - 124);
  EXPECT_EQ(decimal.rest, (CoordinateRest{2, 55}));  // -1.24 + 0.0055
  const auto binary = LatticeOf(2, 1, false, 0).Split(0, kExtent, 2.8125);
  EXPECT_EQ(binary.k, 5);
  EXPECT_EQ(binary.rest, (CoordinateRest{3, 5}));  // 2.5 + 5/16
}

TEST(ExactLattice, KeepsRawWhatNoDigitsDescribe) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (double x : {infinity, -infinity, std::nan("7"), -0.0, 1e300}) {
    for (uint32_t radix : {2u, 10u}) {
      const auto split = LatticeOf(radix, 5, false, 0).Split(0, 1001, x);
      EXPECT_EQ(split.rest, (CoordinateRest{CoordinateRest::kRaw, BitsOf(x)}));
      EXPECT_EQ(split.k, x == 0 ? 0 : 500);
    }
  }
  // Outside of the box.
  const auto above = LatticeOf(10, 1, false, 0).Split(0, 50, 5.1);
  EXPECT_EQ(above.k, 50);
  EXPECT_EQ(above.rest.digits, CoordinateRest::kRaw);
}

TEST(ExactLattice, CountsDecimalsAndBits) {
  EXPECT_EQ(DecimalsOf(0, false), 0);
  EXPECT_EQ(DecimalsOf(-17, true), 0);
  EXPECT_EQ(DecimalsOf(static_cast<double>(0.1f), true), 1);
  EXPECT_EQ(DecimalsOf(0.000123, false), 6);
  EXPECT_EQ(DecimalsOf(std::sqrt(2) * 1e7, false), ExactStep::kMostDecimals + 1);
  EXPECT_EQ(FractionBitsOf(1), 0);
  EXPECT_EQ(FractionBitsOf(-48), -4);
  EXPECT_EQ(FractionBitsOf(0.375), 3);
  EXPECT_EQ(FractionBitsOf(std::numeric_limits<double>::denorm_min()), 1074);
}

TEST(FloatBits, AreKeptByWideningAndNarrowing) {
  std::mt19937 random(3);
  for (int i = 0; i < 100000; ++i) {
    auto bits = static_cast<uint32_t>(random());
    if (i % 2 == 0) bits |= 0x7f800000;  // infinities and NaN, quiet and signalling
    EXPECT_EQ(NarrowToFloatBits(WidenFloat(std::bit_cast<float>(bits))), bits);
  }
  // A NaN that no float widens to stays one.
  const double small_payload = std::bit_cast<double>(uint64_t{0x7ff0000000000001});
  EXPECT_TRUE(std::isnan(std::bit_cast<float>(NarrowToFloatBits(small_payload))));
}

}  // namespace
}  // namespace folprom
