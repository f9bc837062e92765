// A distribution in which single cells weigh more than those between them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace folprom {

/// The heavy cells near a prediction, and what the others far from it weigh on average.
struct PlaneWindow {
  static constexpr size_t kMost = 8;
  size_t count = 0;
  std::array<int64_t, kMost> cell;  ///< ascending
  std::array<double, kMost> added;  ///< mass that the cell has beside its own
  int64_t first = 0, last = 0;      ///< cells [first, last) are told apart
  double below_first = 0, below_last = 0;
  double outside = 1;  ///< weight of all others

  /// Is there a heavy cell in [begin, end).
  bool Any(int64_t begin, int64_t end) const {
    for (size_t i = 0; i < count; ++i) {
      if (cell[i] >= begin && cell[i] < end) return true;
    }
    return false;
  }
  /// Mass below cell `at`, of which the distribution without weights has `below` there.
  double Weighted(int64_t at, double below) const {
    if (at <= first) return outside * below;
    double mass = outside * below_first;
    for (size_t i = 0; i < count && cell[i] < at; ++i) mass = mass + added[i];
    if (at <= last) return mass + (below - below_first);
    return mass + (below_last - below_first) + outside * (below - below_last);
  }
};

}  // namespace folprom
