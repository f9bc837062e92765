#include "engine/entropy/value_tally.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace folprom {
namespace {

TEST(ValueTally, OneValueTellsNothing) {
  ValueTally tally;
  EXPECT_EQ(tally.EntropyBits(), 0);
  for (int i = 0; i < 100; ++i) tally.Add(-7);
  EXPECT_EQ(tally.values(), 100u);
  EXPECT_EQ(tally.EntropyBits(), 0);
}

TEST(ValueTally, EquallyFrequentValuesCostTheirLogarithm) {
  ValueTally tally;
  for (int64_t i = 0; i < 800; ++i) tally.Add(i % 8 - (int64_t{1} << 40));
  EXPECT_NEAR(tally.EntropyBits(), 800 * 3, 1e-6);
}

TEST(ValueTally, UnequalValuesCostTheirEntropy) {
  ValueTally tally;
  for (int i = 0; i < 400; ++i) tally.Add(i % 4 == 0 ? 1 : 0);
  EXPECT_NEAR(tally.EntropyBits() / 400, 0.8112781244591328, 1e-9);
}

TEST(ValueTally, KeepsContextsApart) {
  ValueTally tally;
  for (int i = 0; i < 100; ++i) tally.Add(i % 2, static_cast<uint32_t>(i % 2));
  EXPECT_EQ(tally.values(), 100u);
  EXPECT_EQ(tally.EntropyBits(), 0);
}

}  // namespace
}  // namespace folprom
