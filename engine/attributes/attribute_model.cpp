#include "engine/attributes/attribute_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

/// Half octaves that contexts tell apart: of spreads, of the miss before, and of the one before
/// that.
constexpr uint32_t kSizes = 12, kBefore = 8, kBeforeThat = 6;

/// Half octaves of a size, from 1/8 on; 0 for nothing.
uint32_t BucketOf(double size, uint32_t count) {
  if (!(size > 0.001)) return 0;
  const int half = HalfOctave(static_cast<uint64_t>(std::min(size, 1e6) * 64)) - 6;
  return static_cast<uint32_t>(std::clamp(half, 1, static_cast<int>(count) - 1));
}

/// Features stay far below what would spoil a regression.
double Bounded(double value) { return std::clamp(value, -64.0, 64.0); }

/// A rest of this octave is some 2^-octave.
constexpr uint32_t kRestOctaves = 16;
uint32_t RestOctave(double size) {
  uint32_t octave = 0;
  for (; octave + 1 < kRestOctaves && size < 0.5; size = size * 2) ++octave;
  return octave;
}

/// The mean of sizes, those of outliers cut.
void Learn(double size, LearnedScale* scale) {
  if (scale->count < 250) scale->count = scale->count + 1;
  const double cut = std::min(size, 8 * scale->mean);
  scale->mean = std::max(scale->mean + (cut - scale->mean) / (scale->count + 3), 1e-30);
}

double FirstUnit(const ValueSpan& span) {
  const double range = RealOf(span, span.most) - RealOf(span, span.least);
  return range > 1e-30 && range < 1e30 ? range / 32 : 1;
}

}  // namespace

AttributeModel::AttributeModel(const ValueSpan& span)
    : span_(span),
      unit_{FirstUnit(span), 0},
      regression_({0.2, 0, 0.4, 0, 0, 0}),
      scales_(kSizes * kBefore, 0.5),
      plain_scales_(kSizes, 0.7),
      rest_scales_(kRestOctaves, {0.01, 0}),
      values_({kSizes * kBefore, kSizes * kSizes, kBefore * kBeforeThat}) {}

template <class Coder>
uint64_t AttributeModel::Code(Coder& coder, const RingValues& ring, const VertexValues& before,
                              uint64_t value, double* miss) {
  const double unit = unit_.mean;
  const std::array<double, kFeatures> features{Bounded((ring.parent - ring.mean) / unit),
                                               Bounded((ring.even - ring.mean) / unit),
                                               before.misses[0],
                                               before.misses[1],
                                               Bounded((ring.nearest - ring.mean) / unit),
                                               Bounded((ring.surface - ring.mean) / unit)};
  const double predicted = regression_.Predict(features);
  const uint32_t spread = BucketOf(ring.spread / unit, kSizes);
  const uint32_t last = BucketOf(std::fabs(before.misses[0]), kBefore);
  const uint32_t size = spread * kBefore + last;
  const double mean = std::clamp(ring.mean + predicted * unit, -1e300, 1e300);
  constexpr double kLeastScale = 1e-40, kPerMiss = 0.6;
  std::array<ValuePrediction, 2> predictions{
      ValuePrediction{mean, std::max(scales_.Of(size) * unit * kPerMiss, kLeastScale)},
      ValuePrediction{ring.mean,
                      std::max(plain_scales_.Of(spread) * unit * kPerMiss, kLeastScale)}};
  double rest = 0;
  uint32_t octave = 0;
  if (before.rest) {
    rest = mean < 0 ? -*before.rest : *before.rest;
    octave = RestOctave(*before.rest);
    predictions[1] = {rest, std::max(rest_scales_[octave].mean * kPerMiss, kLeastScale)};
    // The search begins where it was nearer of late.
    if (rest_wrong_ < mean_wrong_) std::swap(predictions[0], predictions[1]);
  }
  const uint32_t apart = BucketOf(std::fabs(ring.parent - ring.mean) / unit, kSizes);
  const uint32_t last2 = BucketOf(std::fabs(before.misses[1]), kBeforeThat);
  value = values_.Code(coder, {size, spread * kSizes + apart, last * kBeforeThat + last2},
                       predictions, span_, value);

  const double real = RealOf(span_, value);
  *miss = Bounded((real - ring.mean) / unit);
  regression_.Learn(features, *miss);
  scales_.Learn(size, std::fabs(Bounded((real - mean) / unit)));
  plain_scales_.Learn(spread, std::fabs(*miss));
  if (before.rest) {
    Learn(std::fabs(real - rest), &rest_scales_[octave]);
    rest_wrong_ = rest_wrong_ + (std::min(std::fabs(real - rest) / unit, 1.0) - rest_wrong_) / 32;
    mean_wrong_ = mean_wrong_ + (std::min(std::fabs(real - mean) / unit, 1.0) - mean_wrong_) / 32;
  }
  Learn(std::fabs(real - ring.mean), &unit_);
  return value;
}

template uint64_t AttributeModel::Code<BitEncoder>(BitEncoder&, const RingValues&,
                                                   const VertexValues&, uint64_t, double*);
template uint64_t AttributeModel::Code<BitDecoder>(BitDecoder&, const RingValues&,
                                                   const VertexValues&, uint64_t, double*);

}  // namespace folprom
