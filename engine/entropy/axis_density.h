// A density on a line, summed from boxes, whose distribution function costs one look-up.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace folprom {

class AxisDensity {
 public:
  /// Empties it; the boxes will lie between lo and hi.
  void Start(double lo, double hi) {
    lo_ = lo;
    per_bin_ = static_cast<double>(kBins) / std::max(hi - lo, 1e-9);
    mass_.fill(0);
  }
  /// Mass as wide as a tent over [middle - half, middle + half] looks, which is a box of three
  /// quarters of that; a bin at least.
  void Add(double middle, double half, double mass) {
    const double reach = std::max(half * per_bin_ * 0.75, 0.5);
    const double left = std::clamp((middle - lo_) * per_bin_ - reach, 0.0, kLast);
    const double right = std::clamp((middle - lo_) * per_bin_ + reach, left + 1e-9, kLast + 1e-9);
    const double share = mass / (right - left);
    size_t bin = static_cast<size_t>(left);
    double at = left;
    while (at < right && bin < kBins) {
      const double end = std::min(right, static_cast<double>(bin + 1));
      mass_[bin] = mass_[bin] + share * (end - at);
      at = end;
      ++bin;
    }
  }
  /// Turns masses into the distribution function; a little is spread over everything.
  void Finish() {
    double total = 0;
    for (double mass : mass_) total = total + mass;
    const double floor = total > 0 ? total * 1e-3 / kBins : 1.0;
    double sum = 0;
    total = total + floor * kBins;
    for (size_t i = 0; i < kBins; ++i) {
      below_[i] = sum / total;
      sum = sum + mass_[i] + floor;
    }
    below_[kBins] = 1;
  }
  double Below(double x) const {
    const double at = std::clamp((x - lo_) * per_bin_, 0.0, kLast);
    const size_t bin = static_cast<size_t>(at);
    return below_[bin] + (at - static_cast<double>(bin)) * (below_[bin + 1] - below_[bin]);
  }

 private:
  static constexpr size_t kBins = 64;
  static constexpr double kLast = static_cast<double>(kBins) - 1e-6;
  double lo_ = 0, per_bin_ = 1;
  std::array<double, kBins> mass_{};
  std::array<double, kBins + 1> below_{};
};

}  // namespace folprom
