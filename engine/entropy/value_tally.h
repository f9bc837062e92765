// How often each value was coded: what a plain arithmetic coder would pay, for comparison.
#pragma once

#include <cstdint>
#include <map>

#include "engine/entropy/fixed_math.h"

namespace folprom {

/// Counts values under contexts. For measurements; slow beside the coding itself.
class ValueTally {
 public:
  void Add(int64_t value, uint32_t context = 0) {
    ++values_;
    Spread& spread = spreads_[context];
    ++spread.total;
    ++spread.counts[value];
  }

  uint64_t values() const { return values_; }

  /// Entropy of all values together, given their contexts, in bits: an order-zero coder that knows
  /// the frequencies beforehand.
  double EntropyBits() const {
    double bits = 0;
    for (const auto& [context, spread] : spreads_) {
      const double total = static_cast<double>(spread.total);
      for (const auto& [value, count] : spread.counts) {
        bits += static_cast<double>(count) * Log2Exact(total / static_cast<double>(count));
      }
    }
    return bits;
  }

 private:
  struct Spread {
    uint64_t total = 0;
    std::map<int64_t, uint64_t> counts;
  };
  uint64_t values_ = 0;
  std::map<uint32_t, Spread> spreads_;
};

}  // namespace folprom
