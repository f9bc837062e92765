// What came of decisions that were said to be so likely: a map from probabilities to those that
// hold (adaptive probability map: Mahoney, "Data Compression Explained", 4.3.3). Integers only.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace folprom {

class ProbabilityMap {
 public:
  /// Of `sets` kinds of decisions; 0: maps nothing. squash: 65536 / (1 + e^-x), x = (i - 2048) /
  /// 256.
  template <class Table>
  ProbabilityMap(size_t sets, const Table& squash) : points_(sets * kPoints) {
    for (size_t i = 0; i < points_.size(); ++i) {
      points_[i] = squash[std::min<size_t>(i % kPoints * kStep, 4095)];
    }
  }
  bool empty() const { return points_.empty(); }

  /// What holds where ln(p / (1 - p)) is `odds` / 256; -2047 <= odds <= 2047.
  int32_t Refine(size_t set, int32_t odds) {
    const uint32_t at = static_cast<uint32_t>(odds + 2048), part = at % kStep;
    uint16_t* below = &points_[set * kPoints + at / kStep];
    nearest_ = below + (part < kStep / 2 ? 0 : 1);
    return static_cast<int32_t>((below[0] * (kStep - part) + below[1] * part) / kStep);
  }
  /// How the decision refined last came out.
  void Learn(bool bit) {
    const int32_t target = bit ? 65535 : 0, before = *nearest_;
    *nearest_ = static_cast<uint16_t>(before + ((target - before) >> kRate));
  }

 private:
  static constexpr uint32_t kStep = 128;  ///< odds between points
  static constexpr size_t kPoints = 33;
  static constexpr int kRate = 7;

  std::vector<uint16_t> points_;
  uint16_t* nearest_ = nullptr;
};

}  // namespace folprom
