#include "engine/entropy/initial_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/codec/subtree_coder.h"
#include "engine/entropy/cell_model.h"
#include "engine/entropy/mixed_model.h"

namespace folprom {
namespace {

/// Counts pieces of state and changes nothing.
class Counter : public LearnedStateVisitor {
 public:
  void Decisions(std::span<uint32_t> states) override { pieces += states.size(); }
  void Values(std::span<int32_t> values, int32_t) override { pieces += values.size(); }
  void Values(std::span<float> values, float) override { pieces += values.size(); }
  void Values(std::span<double> values, double) override { pieces += values.size(); }
  void Scales(std::span<LearnedScale> scales) override { pieces += scales.size(); }
  size_t pieces = 0;
};

CodecParameters LatticeParameters(bool trained) {
  CodecParameters parameters;
  parameters.settings.trained = trained;
  parameters.extent = {4095, 4095, 4095};
  return parameters;
}

TEST(InitialStatistics, HaveACodeForEveryPieceOfStateAndNoMore) {
  SubtreeShape shape;
  shape.vertices = 2;
  SubtreeCoder coder(LatticeParameters(false), shape);
  Counter counter;
  coder.Visit(counter);
  EXPECT_EQ(InitialStatistics::Trained().codes().size(), counter.pieces);
  StatisticsLoader loader(InitialStatistics::Trained());
  coder.Visit(loader);
  EXPECT_EQ(loader.left(), 0u);
}

TEST(InitialStatistics, ServeTheLatticeAndOnlyWhereAskedFor) {
  EXPECT_EQ(LatticeParameters(true).start(), &InitialStatistics::Trained());
  EXPECT_EQ(LatticeParameters(false).start(), nullptr);
  CodecParameters cylindrical = LatticeParameters(true);
  cylindrical.settings.offsets = Offsets::kCylindrical;
  EXPECT_EQ(cylindrical.start(), nullptr);
}

TEST(StatisticsLoader, StartsAProbabilityAtItsPlaceWithItsConfidence) {
  // Place 40, confidence 3: 8 decisions.
  const InitialStatistics statistics({0, 1 + 40 * 8 + 3});
  StatisticsLoader loader(statistics);
  std::vector<uint32_t> states(3, uint32_t{1} << 31);
  loader.Decisions(states);
  EXPECT_EQ(states[0], uint32_t{1} << 31);
  const double p = static_cast<double>(states[1] >> 10) / (1 << 22);
  EXPECT_NEAR(std::log(p / (1 - p)), (40 - 31.5) * 0.2, 1e-5);
  EXPECT_EQ(states[1] & 1023, 8u);
  EXPECT_EQ(states[2], uint32_t{1} << 31);  // after the last code
}

TEST(StatisticsLoader, AddsStepsToValuesAndCountsScalesAsSeen) {
  const InitialStatistics statistics({-3, 64, 0});
  StatisticsLoader loader(statistics);
  std::vector<double> values{2};
  loader.Values(values, 0.25);
  EXPECT_EQ(values[0], 1.25);
  std::vector<LearnedScale> scales{{1, 0}, {1, 0}};
  loader.Scales(scales);
  EXPECT_EQ(scales[0].mean, 1.5);
  EXPECT_EQ(scales[0].count, InitialStatistics::kScaleConfidence);
  EXPECT_EQ(scales[1].count, 0);
}

}  // namespace
}  // namespace folprom
