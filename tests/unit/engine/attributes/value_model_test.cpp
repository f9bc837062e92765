#include "engine/attributes/value_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

using enum ScalarType;
using Model = ValueModel<1, 2>;

struct Sample {
  uint64_t value;
  std::array<ValuePrediction, 2> predictions;
};

/// Codes the samples both ways; returns the bits.
double RoundTrip(const ValueSpan& span, const std::vector<Sample>& samples) {
  BitEncoder encoder;
  uint64_t meter = 0;
  encoder.SetMeter(&meter);
  Model encoding({1}), decoding({1});
  for (const Sample& sample : samples) {
    EXPECT_EQ(encoding.Code(encoder, {0}, sample.predictions, span, sample.value), sample.value);
  }
  const std::vector<uint8_t> bytes = encoder.TakeSegment();
  BitDecoder decoder;
  decoder.StartSegment(bytes);
  for (const Sample& sample : samples) {
    EXPECT_EQ(decoding.Code(decoder, {0}, sample.predictions, span, 0), sample.value);
  }
  decoder.FinishSegment();
  return static_cast<double>(meter) / 1024;
}

TEST(ValueModelTest, AnyValueComesBackUnderAnyPrediction) {
  std::mt19937_64 random(1);
  const double means[] = {0, 1e300, -1e300, 1e-300, -0.25, 3e38, 255, 4e9};
  const double scales[] = {1e-40, 1e-7, 1, 1e30, 1e300};
  for (const ScalarType type :
       {kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64}) {
    const uint64_t most = LargestOrdered(type);
    for (const ValueSpan& span : {ValueSpan{type, 0, most}, ValueSpan{type, most / 3, most / 2},
                                  ValueSpan{type, most - 1, most}, ValueSpan{type, 5, 5}}) {
      std::vector<Sample> samples;
      for (int i = 0; i < 300; ++i) {
        uint64_t value = span.least;
        if (i % 3 == 1) value = span.most;
        if (i % 3 == 2 && span.most > span.least) {
          value += random() % (span.most - span.least);
        }
        samples.push_back({value,
                           {ValuePrediction{means[random() % 8], scales[random() % 5]},
                            ValuePrediction{means[random() % 8], scales[random() % 5]}}});
      }
      RoundTrip(span, samples);
    }
  }
}

TEST(ValueModelTest, OneValueCostsNothing) {
  EXPECT_EQ(RoundTrip({kFloat64, 77, 77}, {{77, {}}, {77, {}}}), 0);
}

TEST(ValueModelTest, FloatsNearTheirPredictionCostTheirNoise) {
  std::mt19937_64 random(2);
  std::vector<Sample> samples;
  std::normal_distribution<double> noise(0, 1e-4);
  for (int i = 0; i < 4000; ++i) {
    const double mean = 0.75 + 0.2 * std::sin(i);
    const auto value = static_cast<float>(mean + noise(random));
    const uint64_t ordered = NearestOrdered(kFloat32, static_cast<double>(value));
    samples.push_back({ordered, {ValuePrediction{mean, 6e-5}, ValuePrediction{0.5, 0.2}}});
  }
  const double bits = RoundTrip({kFloat32, 0, LargestOrdered(kFloat32)}, samples) / 4000;
  // A normal density of this width over steps of 2^-24 has 12.8 bits.
  EXPECT_LT(bits, 13.1);
  EXPECT_GT(bits, 12.5);
}

}  // namespace
}  // namespace folprom
