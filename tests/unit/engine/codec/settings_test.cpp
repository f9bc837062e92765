#include "folprom/settings.h"

#include <gtest/gtest.h>

#include <limits>

namespace folprom {
namespace {

/// Message of the kUsage error; "" where there is none.
std::string UsageErrorOf(const EncodeOptions& options) {
  const Result<void> checked = CheckOptions(options);
  if (checked.ok()) return "";
  EXPECT_EQ(checked.error().kind, ErrorKind::kUsage);
  return checked.error().message;
}

TEST(CheckOptions, RefusesBitsOutOfRange) {
  for (uint32_t bits : {1u, 12u, 24u}) {
    EncodeOptions options;
    options.bits = bits;
    EXPECT_EQ(UsageErrorOf(options), "") << bits;
  }
  for (uint32_t bits : {0u, 25u, 64u, 0xffffffffu}) {
    EncodeOptions options;
    options.bits = bits;
    EXPECT_NE(UsageErrorOf(options).find("bits is " + std::to_string(bits)), std::string::npos);
  }
}

TEST(CheckOptions, RefusesTolerancesThatAreNone) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (double tolerance : {0.0, 5e-324, 1.0, kLargestTolerance}) {
    EncodeOptions options;
    options.tolerance = tolerance;
    EXPECT_EQ(UsageErrorOf(options), "") << tolerance;
  }
  for (double tolerance :
       {-1.0, 1e41, 1.7e308, infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
    EncodeOptions options;
    options.tolerance = tolerance;
    EXPECT_NE(UsageErrorOf(options).find("tolerance"), std::string::npos) << tolerance;
  }
}

TEST(WithEffort, IsTheDefaultAtFive) {
  const CodecSettings usual, five = WithEffort(usual, 5);
  EXPECT_EQ(five.effort, usual.effort);
  EXPECT_EQ(five.density_step, usual.density_step);
  EXPECT_EQ(five.mixers, usual.mixers);
  EXPECT_EQ(five.models, usual.models);
  EXPECT_EQ(five.subtree_vertices, usual.subtree_vertices);
  EXPECT_EQ(five.step_parts, usual.step_parts);
  EXPECT_EQ(five.rounds_per_step, usual.rounds_per_step);
  EXPECT_EQ(five.length_weight, usual.length_weight);
  EXPECT_EQ(five.distortion_first, usual.distortion_first);
}

TEST(WithEffort, NeverDoesLessForMore) {
  for (uint32_t effort = 1; effort < 9; ++effort) {
    const CodecSettings less = WithEffort({}, effort), more = WithEffort({}, effort + 1);
    EXPECT_TRUE(CheckSettings(less)) << effort;
    EXPECT_TRUE(CheckSettings(more)) << effort;
    EXPECT_EQ(more.effort, effort + 1);
    EXPECT_LE(less.subtree_vertices, more.subtree_vertices);
    EXPECT_LE(less.rounds_per_step, more.rounds_per_step);
    EXPECT_LE(less.mixers, more.mixers);
    EXPECT_EQ(less.models, effort == 1 ? Models::kLight : Models::kFull);
    EXPECT_EQ(more.models, Models::kFull);
    const auto cells = [](uint32_t step) { return step == 0 ? 0 : 5 - step; };
    EXPECT_LE(cells(less.density_step), cells(more.density_step));
    EXPECT_TRUE(less.subtree_vertices < more.subtree_vertices || less.mixers < more.mixers ||
                less.density_step != more.density_step)
        << effort;
  }
}

TEST(WithEffort, LeavesOtherSettingsAlone) {
  CodecSettings settings;
  settings.children = 7;
  settings.curvature_threshold = 0.25;
  settings.fan_cuts = false;
  const CodecSettings nine = WithEffort(settings, 9);
  EXPECT_EQ(nine.children, 7u);
  EXPECT_EQ(nine.curvature_threshold, 0.25);
  EXPECT_FALSE(nine.fan_cuts);
}

TEST(WithEffort, OutOfRangeIsRefused) {
  for (uint32_t effort : {0u, 10u, 0xffffffffu}) {
    EncodeOptions options;
    options.codec = WithEffort(options.codec, effort);
    EXPECT_NE(UsageErrorOf(options).find("setting effort is"), std::string::npos) << effort;
  }
}

TEST(CheckOptions, RefusesExactWithoutLatticeOffsets) {
  EncodeOptions options;
  options.exact = true;
  EXPECT_EQ(UsageErrorOf(options), "");
  options.codec.offsets = Offsets::kCylindrical;
  EXPECT_NE(UsageErrorOf(options).find("exact"), std::string::npos);
  options.codec.hierarchy = Hierarchy::kLloyd;
  EXPECT_NE(UsageErrorOf(options).find("exact"), std::string::npos);
}

}  // namespace
}  // namespace folprom
