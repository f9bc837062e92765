#include "engine/entropy/probability_map.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "engine/entropy/mixed_model.h"

namespace folprom {
namespace {

TEST(ProbabilityMap, SaysAtFirstWhatItIsTold) {
  ProbabilityMap map(2, detail::kSquash);
  for (int32_t odds = -2047; odds <= 2047; ++odds) {
    const int32_t told = detail::kSquash[static_cast<size_t>(odds + 2048)];
    EXPECT_LE(std::abs(map.Refine(1, odds) - told), 600) << odds;
  }
}

TEST(ProbabilityMap, LearnsWhatHoldsInEachSet) {
  ProbabilityMap map(2, detail::kSquash);
  std::mt19937_64 random(1);
  const int32_t before = map.Refine(1, 300);
  for (int i = 0; i < 20000; ++i) {
    // Told that they are likely, they hold one time in four.
    map.Refine(0, 300);
    map.Learn(random() % 4 == 0);
  }
  EXPECT_NEAR(map.Refine(0, 256), 16384, 3000);
  EXPECT_EQ(map.Refine(1, 300), before);
}

TEST(ProbabilityMap, StaysInSixteenBits) {
  ProbabilityMap map(1, detail::kSquash);
  for (int i = 0; i < 5000; ++i) {
    EXPECT_LE(map.Refine(0, 2047), 65535);
    map.Learn(true);
    EXPECT_GE(map.Refine(0, -2047), 0);
    map.Learn(false);
  }
}

TEST(ProbabilityMap, OfNoSetsIsEmpty) { EXPECT_TRUE(ProbabilityMap(0, detail::kSquash).empty()); }

}  // namespace
}  // namespace folprom
