#include "tests/bench/ablation/measurement.h"

#include <algorithm>
#include <cmath>

#include "engine/codec/encode_subtree.h"
#include "engine/encode_job.h"
#include "parallel/progress.h"

namespace folprom::bench {
namespace {

/// Enough for half a percent of a mean: its error falls with the root of the number.
constexpr uint64_t kSamples = 300'000;
constexpr double kRatesPerOctave = 4;

Curve::Point PointOf(const RatePoint& point) {
  const Comparison& c = point.comparison;
  const double unit = c.diagonal / 1e4;
  return {point.bits_per_vertex, std::max(c.forward.mean, c.backward.mean) / unit,
          std::max(c.forward.rms, c.backward.rms) / unit};
}

}  // namespace

Costs CostsOf(const std::string& scan, const EncodeOptions& options, parallel::Runner& runner) {
  parallel::Progress progress;
  EncodeJob job(scan, options, runner, progress);
  job.MeasureScan();
  job.Partition();
  Costs costs;
  costs.vertices = job.source().vertex_count();
  costs.meters.offsets.tally = &costs.offsets;
  costs.meters.connectivity.tally = &costs.flags;
  for (size_t subtree = 0; subtree < job.scan().subtree_count(); ++subtree) {
    const SubtreeChunk chunk = job.scan().Load(subtree);
    costs.meters = EncodeSubtree(chunk, job.scan().summary(subtree), static_cast<uint32_t>(subtree),
                                 job.parameters(), costs.meters)
                       .meters;
  }
  // The tallies end here or move.
  costs.meters.offsets.tally = nullptr;
  costs.meters.connectivity.tally = nullptr;
  return costs;
}

std::optional<double> Curve::At(double rate, double Point::*error) const {
  if (points.empty() || rate < points.front().bits_per_vertex) return std::nullopt;
  size_t next = 0;
  while (next < points.size() && points[next].bits_per_vertex <= rate) ++next;
  const Point& before = points[next - 1];
  if (next == points.size()) return before.*error;
  const Point& after = points[next];
  if (after.bits_per_vertex > 2 * before.bits_per_vertex) return before.*error;
  const double part = std::log(rate / before.bits_per_vertex) /
                      std::log(after.bits_per_vertex / before.bits_per_vertex);
  return before.*error * std::pow(after.*error / before.*error, part);
}

Curve CurveOf(const std::string& scan, const EncodeOptions& options, double lowest, double highest,
              parallel::Runner& runner) {
  std::vector<double> rates;
  const double step = std::exp2(1 / kRatesPerOctave);
  // An octave more on both sides, for the layers next to the ends.
  for (double rate = lowest / 2; rate <= highest * 2; rate *= step) rates.push_back(rate);
  parallel::Progress progress;
  const RateCurve measured = MeasureRates(scan, options, rates, kSamples, runner, progress).value();
  Curve curve;
  for (const RatePoint& point : measured.points) {
    const Curve::Point next = PointOf(point);
    const bool same =
        !curve.points.empty() && curve.points.back().bits_per_vertex == next.bits_per_vertex;
    if (!same) curve.points.push_back(next);
  }
  return curve;
}

}  // namespace folprom::bench
