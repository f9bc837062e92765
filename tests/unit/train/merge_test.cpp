#include "apps/train/merge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/entropy/initial_statistics.h"

namespace folprom::train {
namespace {

WeightedLesson Saw(double probability, double count) {
  return {{{Kind::kDecision, probability, count}}, 1};
}
double PlaceOf(int16_t code) {
  const double odds = InitialStatistics::OddsAt((code - 1) / 8);
  return 1 / (1 + std::exp(-odds));
}
uint32_t ConfidenceOf(int16_t code) {
  return InitialStatistics::kConfidences[static_cast<size_t>((code - 1) % 8)];
}

TEST(MergeDecisions, OfWhatNoLessonSawSayNothing) {
  EXPECT_EQ(Merge({Saw(0.5, 0), Saw(0.5, 0)}), std::vector<int16_t>{0});
}

TEST(MergeDecisions, LieBetweenTheLessons) {
  const int16_t code = Merge({Saw(0.1, 40), Saw(0.4, 40)})[0];
  EXPECT_GT(PlaceOf(code), 0.1);
  EXPECT_LT(PlaceOf(code), 0.4);
}

TEST(MergeDecisions, TrustLessonsThatAgreeMore) {
  const int16_t agree = Merge({Saw(0.2, 40), Saw(0.2, 40), Saw(0.2, 40), Saw(0.2, 40)})[0];
  const int16_t differ = Merge({Saw(0.02, 40), Saw(0.4, 40), Saw(0.05, 40), Saw(0.6, 40)})[0];
  EXPECT_GT(ConfidenceOf(agree), 2 * ConfidenceOf(differ));
}

TEST(MergeValues, AreMeansOfWhatScansWeigh) {
  const WeightedLesson one{{{Kind::kValue, 10, 1}}, 0.25}, other{{{Kind::kValue, -2, 1}}, 0.75};
  EXPECT_EQ(Merge({one, other}), std::vector<int16_t>{1});
}

TEST(MergeScales, CountOnlyWhatWasSeen) {
  const WeightedLesson seen{{{Kind::kScale, 6, 40}}, 1}, unseen{{{Kind::kScale, 0, 0}}, 1};
  EXPECT_EQ(Merge({seen, unseen}), std::vector<int16_t>{6});
}

}  // namespace
}  // namespace folprom::train
