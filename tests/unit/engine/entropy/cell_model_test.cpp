#include "engine/entropy/cell_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

using Plain = CellModel<1, 2>;
using Dense = CellModel<1, 1, 1>;

struct Sample {
  std::array<CellPrediction, 2> predictions;
  int32_t lo, hi, value;
};

void ExpectRoundTrip(const std::vector<Sample>& samples) {
  BitEncoder encoder;
  Plain writer({3});
  for (size_t i = 0; i < samples.size(); ++i) {
    const Sample& s = samples[i];
    const std::array<uint32_t, 1> context{static_cast<uint32_t>(i % 3)};
    ASSERT_EQ(writer.Code(encoder, context, s.predictions, s.lo, s.hi, s.value), s.value);
  }
  const std::vector<uint8_t> bytes = encoder.TakeSegment();
  BitDecoder decoder;
  decoder.StartSegment(bytes);
  Plain reader({3});
  for (size_t i = 0; i < samples.size(); ++i) {
    const Sample& s = samples[i];
    const std::array<uint32_t, 1> context{static_cast<uint32_t>(i % 3)};
    ASSERT_EQ(reader.Code(decoder, context, s.predictions, s.lo, s.hi, s.lo), s.value) << i;
  }
  decoder.FinishSegment();
}

TEST(CellModel, EveryValueOfSmallRangesComesBack) {
  std::vector<Sample> samples;
  for (int32_t lo : {-9, 0, 5}) {
    for (int32_t width = 0; width < 20; ++width) {
      for (int32_t value = lo; value <= lo + width; ++value) {
        for (double mean : {-1e18, -3.0, 0.5, 7.25, 1e18}) {
          samples.push_back({{{{mean, 1}, {mean / 2, 0.05}}}, lo, lo + width, value});
        }
      }
    }
  }
  ExpectRoundTrip(samples);
}

TEST(CellModel, ExtremeRangesAndPredictionsComeBack) {
  constexpr int32_t kLeast = std::numeric_limits<int32_t>::min();
  constexpr int32_t kMost = std::numeric_limits<int32_t>::max();
  std::mt19937_64 random(1);
  std::vector<Sample> samples;
  for (auto [lo, hi] : {std::pair{kLeast, kMost},
                        {0, (1 << 30) - 1},
                        {kLeast, kLeast + 1},
                        {kMost - 1, kMost},
                        {kMost, kMost}}) {
    for (double mean : {-1e300, -4e9, -0.5, 0.0, 1e6, 2147483647.0, 1e300}) {
      for (double scale : {1e-9, 0.05, 1.0, 1e9, 1e300}) {
        const int64_t width = int64_t{hi} - lo + 1;
        const int64_t drawn = lo + static_cast<int64_t>(random() % static_cast<uint64_t>(width));
        for (int64_t value : {int64_t{lo}, int64_t{hi}, drawn}) {
          samples.push_back({{{{mean, scale}, {0, 1}}}, lo, hi, static_cast<int32_t>(value)});
        }
      }
    }
  }
  ExpectRoundTrip(samples);
}

TEST(CellModel, OneValueCostsNothing) {
  BitEncoder encoder;
  Plain model({1});
  for (int32_t at : {-5, 0, 1 << 30}) {
    EXPECT_EQ(model.Code(encoder, {0}, {{{1e9, 1}, {-1e9, 1}}}, at, at, at), at);
  }
  EXPECT_EQ(encoder.decisions(), 0u);
  EXPECT_TRUE(encoder.TakeSegment().empty());
}

/// Bits per value where values have a deviation of 10 and predictions are `off` beside their mean.
double CostWith(double off, double scale) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> around(5000, 10);
  BitEncoder encoder;
  uint64_t cost = 0;
  encoder.SetMeter(&cost);
  Plain model({1});
  for (int i = 0; i < 500; ++i) {
    const double value = std::floor(around(random));
    const CellPrediction prediction{5000 + off, scale};
    model.Code(encoder, {0}, {{prediction, prediction}}, 0, 10000, static_cast<int32_t>(value));
  }
  return static_cast<double>(cost) / 1024 / 500;
}

TEST(CellModel, GoodPredictionsCostFewerBitsThanPoorOnes) {
  const double good = CostWith(0, 6);
  // The deviation of 10 has an entropy of 5.37 bits.
  EXPECT_LT(good, 5.37 + 0.5);
  EXPECT_LT(good, CostWith(0, 600) - 0.1) << "too wide";
  EXPECT_LT(good, CostWith(300, 6) - 0.1) << "beside";
  EXPECT_LT(good, CostWith(0, 0.05) - 0.1) << "too sure";
}

TEST(CellModel, MeasuredDensityHelpsAndComesBack) {
  // Two peaks, which no logistic density has.
  AxisDensity axis;
  axis.Start(-30, 30, 3);
  axis.Add(Lanes{-30, 30, 0, 0}, Lanes{1, 1, 0, 0});
  axis.Finish();
  AxisDensity flat;
  flat.Start(-40, 40, 0);
  flat.Finish();
  std::mt19937_64 random(3);
  std::vector<int32_t> values;
  for (int i = 0; i < 500; ++i) {
    const int32_t peak = random() % 2 == 0 ? 70 : 130;
    values.push_back(peak + static_cast<int32_t>(random() % 5) - 2);
  }
  std::array<uint64_t, 2> cost{};
  for (size_t d = 0; d < 2; ++d) {
    const CellDensity density{d == 0 ? &axis : &flat, 100, 1};
    BitEncoder encoder;
    encoder.SetMeter(&cost[d]);
    Dense writer({1}), reader({1});
    for (int32_t v : values) writer.Code(encoder, {0}, {{{100, 20}}}, 0, 200, v, density);
    const std::vector<uint8_t> bytes = encoder.TakeSegment();
    BitDecoder decoder;
    decoder.StartSegment(bytes);
    for (int32_t v : values) {
      ASSERT_EQ(reader.Code(decoder, {0}, {{{100, 20}}}, 0, 200, 0, density), v);
    }
  }
  EXPECT_LT(cost[0], cost[1]);
}

TEST(CellModel, ElementaryFunctionsAreAsPreciseAsPromised) {
  for (double x = -60; x <= 60; x += 0.037) {
    EXPECT_NEAR(detail::FastExp2(x) / std::exp2(x), 1, 1e-4) << x;
  }
  for (double x = 1e-17; x < 1e18; x *= 1.37) {
    EXPECT_NEAR(detail::FastLog(x), std::log(x), 1e-4) << x;
  }
}

TEST(ScaleTable, FollowsTheMeanOfEachContextAlone) {
  ScaleTable table(2, 1);
  EXPECT_EQ(table.Of(0), 1);
  for (int i = 0; i < 1000; ++i) table.Learn(0, i % 2 == 0 ? 3 : 5);
  EXPECT_NEAR(table.Of(0), 4, 0.05);
  EXPECT_EQ(table.Of(1), 1);
}

}  // namespace
}  // namespace folprom
