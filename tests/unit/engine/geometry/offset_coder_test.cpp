#include "engine/geometry/offset_coder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/entropy/bit_coder.h"
#include "folprom/result.h"

namespace folprom {
namespace {

constexpr double kLeast = 30.5;

/// A vertex with a ring of about `spacing`, and its neighbourhood.
Neighbourhood RandomNeighbourhood(std::mt19937_64& random, double spacing) {
  std::uniform_real_distribution<double> part(-1, 1);
  const Int3 vertex{1 << 28, 1 << 28, 1 << 28};
  std::vector<Int3> ring;
  for (uint64_t i = 0; i < random() % 9; ++i) {
    auto at = [&](double flat) {
      return (1 << 28) + static_cast<int32_t>(flat * spacing * part(random));
    };
    ring.push_back({at(1), at(1), at(0.2)});
  }
  return MeasureNeighbourhood(vertex, ring, spacing);
}

std::vector<OffsetSettings> AllSettings() {
  std::vector<OffsetSettings> all;
  for (uint32_t children : {2u, 3u, 4u, 8u}) {
    for (uint32_t levels : {2u, 32u, 4096u}) {
      for (bool on : {true, false}) {
        all.push_back({children, levels, on, on, on});
        all.push_back({children, levels, on, !on, on});
        all.push_back({children, levels, on, on, !on});
        all.push_back({children, levels, on, true, on, true});
      }
    }
  }
  return all;
}

TEST(OffsetCoder, StepsFollowTheRangesAndNeverFallBelowTheLeast) {
  Neighbourhood at;
  at.range_rho = 32000;
  at.range_z = 640;
  OffsetSteps steps = OffsetCoder({4, 32, true, true, true}).StepsFor(at, kLeast);
  EXPECT_EQ(steps.rho, 1000);
  EXPECT_EQ(steps.z, kLeast);
  EXPECT_NEAR(steps.theta, 2 * kPi / 32, 1e-15);
  steps = OffsetCoder({4, 32, false, true, true}).StepsFor(at, kLeast);
  EXPECT_EQ(steps.rho, 1000);
  EXPECT_EQ(steps.z, 1000);
  // x and y reach to both sides of the axis.
  steps = OffsetCoder({4, 32, true, true, true, true}).StepsFor(at, kLeast);
  EXPECT_EQ(steps.rho, 2000);
  EXPECT_EQ(steps.theta, 2000);
  EXPECT_EQ(steps.z, kLeast);
}

TEST(OffsetCoder, CellHoldsThePointThatWasQuantised) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> part(-1, 1);
  for (const OffsetSettings& settings : AllSettings()) {
    const OffsetCoder coder(settings);
    for (int round = 0; round < 300; ++round) {
      const double spacing = std::exp2(8 + static_cast<double>(random() % 16));
      const Neighbourhood at = RandomNeighbourhood(random, spacing);
      const OffsetSteps steps = coder.StepsFor(at, kLeast);
      auto near = [&] { return (1 << 28) + static_cast<int32_t>(spacing * part(random)); };
      const Int3 point{near(), near(), near()};
      const OffsetIndex index = coder.Quantise(at, steps, point);
      if (!settings.cartesian) {
        ASSERT_LT(index.theta, settings.levels);
      }
      const CylinderCell cell = coder.CellOf(at, steps, index);
      const CylinderPoint local = ToCylinder(cell.frame, point);
      EXPECT_LE(std::fabs(local.rho - cell.centre.rho), steps.rho / 2 * (1 + 1e-9));
      EXPECT_LE(std::fabs(local.z - cell.centre.z), steps.z / 2 * (1 + 1e-9));
      double turn = std::fabs(local.theta - cell.centre.theta);
      if (!settings.cartesian) turn = std::min(turn, 2 * kPi - turn);
      EXPECT_LE(turn, steps.theta / 2 * (1 + 1e-9));
    }
  }
}

/// One split: what is coded for it.
struct Split {
  OffsetCoder::SetContext context;
  Neighbourhood at;
  uint32_t count;
  std::vector<OffsetIndex> offsets;
};

std::vector<Split> RandomSplits(const OffsetSettings& settings, uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Split> splits;
  for (int i = 0; i < 300; ++i) {
    Split split;
    split.context = {std::exp2(static_cast<double>(random() % 34)),
                     static_cast<uint32_t>(random() % 9), static_cast<uint32_t>(random() % 9)};
    split.at = RandomNeighbourhood(random, 1e5);
    split.count = 2 + static_cast<uint32_t>(random() % (settings.children - 1));
    for (uint32_t c = 0; c < split.count; ++c) {
      // Up to what a child may be away: 2^30 lattice units in steps of 30.5 and more.
      const uint32_t size = static_cast<uint32_t>(random() % 18);
      const uint32_t theta = static_cast<uint32_t>(random() % settings.levels);
      const uint32_t zero = uint32_t{1} << 31;  // of x and y
      if (settings.cartesian) {
        const uint32_t y = zero + (static_cast<uint32_t>(random()) & ((1u << size) - 1));
        split.offsets.push_back({zero - theta, y, static_cast<int32_t>(theta)});
        continue;
      }
      split.offsets.push_back(
          {theta, static_cast<uint32_t>(random() & ((1u << size) - 1)),
           static_cast<int32_t>(random() & ((1u << size) - 1)) * (random() % 2 == 0 ? 1 : -1)});
    }
    std::sort(split.offsets.begin(), split.offsets.end(), [](const auto& a, const auto& b) {
      return std::tuple(a.theta, a.rho, a.z) < std::tuple(b.theta, b.rho, b.z);
    });
    splits.push_back(split);
  }
  return splits;
}

TEST(OffsetCoder, GivesBackCountsAndOffsets) {
  for (const OffsetSettings& settings : AllSettings()) {
    const std::vector<Split> splits = RandomSplits(settings, settings.levels + settings.children);
    OffsetCoder written(settings), read(settings);
    OffsetMeters meters;
    BitEncoder encoder;
    for (const Split& split : splits) {
      ASSERT_EQ(written.CodeChildCount(encoder, split.context, split.count), split.count);
      const OffsetSteps steps = written.StepsFor(split.at, kLeast);
      std::vector<OffsetIndex> offsets = split.offsets;
      written.CodeOffsets(encoder, split.at, steps, split.count, &offsets, &meters);
    }
    const auto bytes = encoder.TakeSegment();
    BitDecoder decoder;
    decoder.StartSegment(bytes);
    std::vector<OffsetIndex> offsets;
    for (const Split& split : splits) {
      ASSERT_EQ(read.CodeChildCount(decoder, split.context, 0), split.count);
      const OffsetSteps steps = read.StepsFor(split.at, kLeast);
      read.CodeOffsets(decoder, split.at, steps, split.count, &offsets, &meters);
      ASSERT_EQ(offsets.size(), split.count);
      for (uint32_t c = 0; c < split.count; ++c) {
        ASSERT_EQ(offsets[c].theta, split.offsets[c].theta);
        ASSERT_EQ(offsets[c].rho, split.offsets[c].rho);
        ASSERT_EQ(offsets[c].z, split.offsets[c].z);
      }
    }
  }
}

TEST(OffsetCoder, MetersAddUpToTheBitsAndTalliesTakeEachValueOnce) {
  const OffsetSettings settings;
  OffsetCoder coder(settings);
  OffsetTally tally;
  OffsetMeters meters;
  meters.tally = &tally;
  BitEncoder encoder;
  uint64_t children = 0;
  for (const Split& split : RandomSplits(settings, 5)) {
    if (split.count == 1) continue;
    std::vector<OffsetIndex> offsets = split.offsets;
    coder.CodeOffsets(encoder, split.at, coder.StepsFor(split.at, kLeast), split.count, &offsets,
                      &meters);
    children += split.count;
  }
  EXPECT_GT(meters.theta, 0u);
  EXPECT_GT(meters.rho, 0u);
  EXPECT_GT(meters.z, 0u);
  const double bits = static_cast<double>(meters.Sum()) / 1024;
  EXPECT_NEAR(bits, 8 * static_cast<double>(encoder.TakeSegment().size()), 0.01 * bits);
  EXPECT_EQ(tally.theta.values(), children);
  EXPECT_EQ(tally.rho.values(), children);
  EXPECT_EQ(tally.z.values(), children);
}

TEST(OffsetCoder, GivesBackHeightsBesideANeighbourOnTheAxis) {
  // A ring in a plane and one neighbour above the vertex: height over squared distance says
  // nothing.
  for (double reach : {0.0, 1e-11, 1e-6, 1.0}) {
    for (double bend : {-1e30, -1e9, -1.0, 0.0, 1.0, 1e9, 1e30}) {
      Neighbourhood at;
      at.range_rho = 4000;
      at.range_z = 4000;
      at.directions.push_back({1, 0, reach, bend});
      std::vector<std::vector<OffsetIndex>> all;
      for (int32_t z : {0, 1, -1, 37, -37, 1000000, -1000000})
        all.push_back({{3, 8, z}, {9, 2, -z}});
      OffsetCoder written({}), read({});
      OffsetMeters meters;
      BitEncoder encoder;
      const OffsetSteps steps = written.StepsFor(at, kLeast);
      for (std::vector<OffsetIndex> offsets : all) {
        written.CodeOffsets(encoder, at, steps, 2, &offsets, &meters);
      }
      const auto bytes = encoder.TakeSegment();
      BitDecoder decoder;
      decoder.StartSegment(bytes);
      std::vector<OffsetIndex> offsets;
      for (const auto& expected : all) {
        read.CodeOffsets(decoder, at, steps, 2, &offsets, &meters);
        EXPECT_EQ(offsets[0].z, expected[0].z) << reach << " " << bend;
        EXPECT_EQ(offsets[1].z, expected[1].z) << reach << " " << bend;
      }
    }
  }
}

TEST(OffsetCoder, GivesBackHalves) {
  std::mt19937_64 random(3);
  std::vector<std::pair<CylinderCell, bool>> halves;
  for (int i = 0; i < 5000; ++i) {
    CylinderCell cell;
    cell.width = {static_cast<double>(random() % 1000), 0.1, 5};
    cell.centre.rho = static_cast<double>(random() % 100000);
    halves.emplace_back(cell, random() % 3 == 0);
  }
  OffsetCoder written({}), read({});
  BitEncoder encoder;
  for (size_t i = 0; i < halves.size(); ++i) {
    const auto dimension = static_cast<CylinderCell::Dimension>(i % 3);
    written.CodeHalf(encoder, halves[i].first, dimension, halves[i].second);
  }
  const auto bytes = encoder.TakeSegment();
  BitDecoder decoder;
  decoder.StartSegment(bytes);
  for (size_t i = 0; i < halves.size(); ++i) {
    const auto dimension = static_cast<CylinderCell::Dimension>(i % 3);
    ASSERT_EQ(read.CodeHalf(decoder, halves[i].first, dimension, false), halves[i].second);
  }
}

TEST(OffsetCoder, RandomBytesGiveIndicesInRangeOrAnError) {
  std::mt19937_64 random(4);
  for (int round = 0; round < 2000; ++round) {
    const auto all = AllSettings();
    const OffsetSettings& settings = all[random() % all.size()];
    OffsetCoder coder(settings);
    OffsetMeters meters;
    std::vector<uint8_t> bytes(random() % 60);
    for (auto& byte : bytes) byte = static_cast<uint8_t>(random());
    BitDecoder decoder;
    decoder.StartSegment(bytes);
    const Neighbourhood at = RandomNeighbourhood(random, 1e6);
    const OffsetSteps steps = coder.StepsFor(at, kLeast);
    std::vector<OffsetIndex> offsets;
    try {
      while (true) {
        const uint32_t count = coder.CodeChildCount(decoder, {1e6, 2, 3}, 0);
        ASSERT_GE(count, 2u);
        ASSERT_LE(count, settings.children);
        coder.CodeOffsets(decoder, at, steps, count, &offsets, &meters);
        for (const OffsetIndex& index : offsets) {
          if (!settings.cartesian) {
            ASSERT_LT(index.theta, settings.levels);
          }
          const Int3 extent{(1 << 30) - 1, 1000, 0};
          const Int3 p = coder.CellOf(at, steps, index).Position(extent);
          ASSERT_TRUE(p.x >= 0 && p.x <= extent.x && p.y >= 0 && p.y <= 1000 && p.z == 0);
        }
      }
    } catch (const Failure& failure) {
      ASSERT_EQ(failure.error().kind, ErrorKind::kCorrupt);
    }
  }
}

}  // namespace
}  // namespace folprom
