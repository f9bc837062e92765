// A density on a line, summed from boxes of one width, whose distribution function costs two
// look-ups.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "engine/entropy/lanes.h"

namespace folprom {

class AxisDensity {
 public:
  /// Empties it. The middles of the boxes will lie in [lo, hi]; each is as wide as a tent over
  /// [middle - half, middle + half] looks: three quarters of that.
  void Start(double lo, double hi, double half) {
    const double reach = 0.75 * half, margin = 2 * reach;
    per_bin_ = static_cast<double>(kBins) / std::max(hi - lo + 2 * margin, 1e-9);
    lo_ = lo - margin;
    reach_ = std::max(reach * per_bin_, 0.25);
    for (auto& bin : mass_) bin = AllLanes(0);
  }
  /// A box a lane; without mass it says nothing.
  void Add(Lanes middle, Lanes mass) {
    const Lanes at = (middle - static_cast<float>(lo_)) * static_cast<float>(per_bin_);
    const Lanes inside = LesserOf(GreaterOf(at, AllLanes(0)), AllLanes(kBins - 0.001F));
    const LaneIntegers bin = WholeOf(inside);
    const Lanes after = mass * (inside - FloatsOf(bin)), before = mass - after;
    for (uint32_t lane = 0; lane < kLanes; ++lane) {
      const size_t place = static_cast<size_t>(bin[lane]);
      mass_[place][lane] += before[lane];
      mass_[place + 1][lane] += after[lane];
    }
  }
  /// Turns masses into the distribution function.
  void Finish() {
    double sum = 0, integral = 0;
    for (size_t i = 0; i <= kBins; ++i) {
      integral_[i] = integral;
      sum = sum + static_cast<double>(SumOf(mass_[i]));
      integral = integral + sum;
    }
    per_mass_ = sum > 0 ? 1 / (2 * reach_ * sum) : 0;
    spread_ = sum > 0 ? kSpread : 1;
  }
  double Below(double x) const {
    const double at = std::clamp((x - lo_) * per_bin_, 0.0, static_cast<double>(kBins));
    double below = at < kBins / 2.0 ? 0 : 1;
    if (at > reach_ && at < kBins - reach_) {
      below = (IntegralAt(at + reach_) - IntegralAt(at - reach_)) * per_mass_;
    }
    return below * (1 - spread_) + at * (spread_ / kBins);
  }

 private:
  static constexpr size_t kBins = 64;
  /// A little of the mass is spread over everything.
  static constexpr double kSpread = 1e-3;
  /// Of the distribution of the middles.
  double IntegralAt(double at) const {
    const size_t bin = std::min(static_cast<size_t>(at), kBins - 1);
    return integral_[bin] +
           (at - static_cast<double>(bin)) * (integral_[bin + 1] - integral_[bin]);
  }

  double lo_ = 0, per_bin_ = 1, reach_ = 0.5, per_mass_ = 0, spread_ = 1;
  Lanes mass_[kBins + 1] = {};
  std::array<double, kBins + 1> integral_{};
};

}  // namespace folprom
