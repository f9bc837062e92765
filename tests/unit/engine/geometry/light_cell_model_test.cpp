#include "engine/geometry/light_cell_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

struct Sample {
  double mean, scale;
  int32_t lo, hi, value;
};

void ExpectRoundTrip(const std::vector<Sample>& samples) {
  BitEncoder encoder;
  LightCellModel writer(3), reader(3);
  for (size_t i = 0; i < samples.size(); ++i) {
    const Sample& s = samples[i];
    const CellLogistic density(s.mean, s.scale);
    const auto side = static_cast<uint32_t>(i % 3);
    ASSERT_EQ(writer.Code(encoder, density, s.lo, s.hi, s.value, side), s.value);
  }
  const std::vector<uint8_t> bytes = encoder.TakeSegment();
  BitDecoder decoder;
  decoder.StartSegment(bytes);
  for (size_t i = 0; i < samples.size(); ++i) {
    const Sample& s = samples[i];
    const CellLogistic density(s.mean, s.scale);
    const auto side = static_cast<uint32_t>(i % 3);
    ASSERT_EQ(reader.Code(decoder, density, s.lo, s.hi, 0, side), s.value) << i;
  }
  decoder.FinishSegment();
}

TEST(LightCellModel, EveryValueOfSmallRangesComesBack) {
  std::vector<Sample> samples;
  for (int32_t lo : {-9, 0, 5}) {
    for (int32_t width = 0; width < 20; ++width) {
      for (int32_t value = lo; value <= lo + width; ++value) {
        for (double mean : {-1e18, -3.0, 0.5, 7.25, 1e18}) {
          for (double scale : {0.04, 1.0, 1e9}) {
            samples.push_back({mean, scale, lo, lo + width, value});
          }
        }
      }
    }
  }
  ExpectRoundTrip(samples);
}

TEST(LightCellModel, ExtremeRangesComeBack) {
  constexpr int32_t kLeast = std::numeric_limits<int32_t>::min();
  constexpr int32_t kMost = std::numeric_limits<int32_t>::max();
  std::mt19937_64 random(1);
  std::vector<Sample> samples;
  for (int i = 0; i < 2000; ++i) {
    const auto value = static_cast<int32_t>(static_cast<uint32_t>(random()));
    const double mean = value + std::ldexp(1.0, static_cast<int>(random() % 40));
    samples.push_back({mean, std::ldexp(1.0, static_cast<int>(random() % 36) - 4), kLeast, kMost,
                       i % 7 == 0 ? kMost : value});
  }
  ExpectRoundTrip(samples);
}

TEST(LightCellModel, CertainValuesCostNothing) {
  BitEncoder encoder;
  LightCellModel model;
  EXPECT_EQ(model.Code(encoder, CellLogistic(3, 1), 7, 7, 7), 7);
  EXPECT_EQ(encoder.decisions(), 0u);
}

/// Mean cost in bits of the values of a logistic density, to a model that has seen as many before.
double CostOf(double scale, uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(1e-6, 1 - 1e-6);
  BitEncoder encoder;
  LightCellModel model;
  constexpr int kCount = 20000;
  uint64_t cost = 0;
  for (int i = 0; i < 2 * kCount; ++i) {
    if (i == kCount) encoder.SetMeter(&cost);
    const double mean = 1000 * uniform(random), u = uniform(random);
    const double value = std::floor(mean + scale * std::log(u / (1 - u)));
    model.Code(encoder, CellLogistic(mean, scale), -100000, 100000, static_cast<int32_t>(value));
  }
  return static_cast<double>(cost) / 1024 / kCount;
}

TEST(LightCellModel, LogisticValuesCostLittleMoreThanTheirEntropy) {
  // That of a logistic density is log2(scale) + 2 / ln 2 bits, where cells are small beside it.
  for (double scale : {2.0, 5.0, 20.0}) {
    EXPECT_LT(CostOf(scale, 1), std::log2(scale) + 2 / std::log(2.0) + 0.06) << scale;
  }
}

TEST(LightCellModel, ATrialCostsTheSameAndTeachesNothing) {
  LightCellModel model;
  const CellLogistic density(17.3, 2);
  TrialCoder first, second;
  model.Code(first, density, 0, 100, 22);
  model.Code(second, density, 0, 100, 22);
  EXPECT_GT(first.cost(), 1024u);
  EXPECT_EQ(first.cost(), second.cost());
  BitEncoder encoder;
  uint64_t cost = 0;
  encoder.SetMeter(&cost);
  model.Code(encoder, density, 0, 100, 22);
  EXPECT_EQ(cost, first.cost());
}

}  // namespace
}  // namespace folprom
