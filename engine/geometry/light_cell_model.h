// Integers near a prediction that is a real number: a CellModel of one logistic density, whose
// odds, in steps, are the context of each decision, and no mixer.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/entropy/cell_model.h"
#include "engine/entropy/plain_decision.h"

namespace folprom {

/// A logistic density over cells, of which cell k covers [k, k + 1).
struct CellLogistic {
  CellLogistic(double middle, double scale) : mean(middle), per_scale(1.44269504 / scale) {}
  /// e^((end - mean) / scale), bounded; between powers f and g lies (g - f) / ((1 + f) (1 + g)) of
  /// the density.
  double Power(int64_t end) const {
    return detail::FastExp2(std::clamp((static_cast<double>(end) - mean) * per_scale, -50.0, 50.0));
  }
  /// Between two ends next to each other.
  double Factor() const { return detail::FastExp2(std::min(per_scale, 50.0)); }
  /// What lies in the cell.
  double Mass(int64_t cell) const {
    const double before = Power(cell), behind = Power(cell + 1);
    return (behind - before) / ((1 + before) * (1 + behind));
  }
  double mean, per_scale;
};

/// Of odds a : b, in parts of octaves from 2^least on; 0 <= result < count.
template <int kPartBits>
inline uint32_t OddsStep(double a, double b, int least, uint32_t count) {
  const int64_t step = detail::RoughLog2<kPartBits>(a, b) - (int64_t{least} << kPartBits);
  return static_cast<uint32_t>(std::clamp<int64_t>(step, 0, int64_t{count} - 1));
}

class LightCellModel {
 public:
  /// sides: number of contexts of the first two decisions.
  explicit LightCellModel(uint32_t sides = 1);

  /// Codes value in [lo, hi]. Decisions that the range makes certain cost nothing.
  template <class Coder>
  int32_t Code(Coder& coder, const CellLogistic& density, int32_t lo, int32_t hi, int32_t value,
               uint32_t side_context = 0);

 private:
  static constexpr uint32_t kSteps = 64, kOctaves = 8;
  static constexpr int kLeastOdds = -8;
  /// By step of the odds.
  using Row = std::array<PlainState, kSteps>;
  static Row FirstRow();
  static PlainState* StateAt(Row* row, double for_true, double for_false) {
    return &(*row)[OddsStep<2>(for_true + 1e-12, for_false + 1e-12, kLeastOdds, kSteps)];
  }

  std::vector<Row> upper_;                 ///< by side context
  std::array<std::vector<Row>, 2> first_;  ///< beyond the first cell; by side and side context
  std::array<std::array<Row, kOctaves>, 2> further_, nearer_half_;
};

template <class Coder>
int32_t LightCellModel::Code(Coder& coder, const CellLogistic& density, int32_t lo, int32_t hi,
                             int32_t value, uint32_t side_context) {
  constexpr double kMost = 1e40;
  int64_t a = lo, c = int64_t{hi} + 1;
  const auto base = static_cast<int64_t>(
      std::floor(std::clamp(density.mean, static_cast<double>(lo), static_cast<double>(hi))));
  const double end = density.Power(base + 1);
  bool upper = base + 1 < c;
  if (upper) {
    upper = CodePlain(coder, StateAt(&upper_[side_context], 1, end), value > base);
    (upper ? a : c) = base + 1;
  }
  // Groups of 1, 2, 4 .. cells away from the base. Below it powers are those of the mirror image.
  const uint32_t side = upper ? 1 : 0;
  double near = upper ? end : 1 / end, far = near, factor = density.Factor();
  uint32_t octave = 0;
  for (int64_t step = 1; c - a > step; step = step * 2, ++octave) {
    far = std::min(near * factor, kMost);
    factor = std::min(factor * factor, kMost);
    Row& row =
        octave == 0 ? first_[side][side_context] : further_[side][std::min(octave, kOctaves - 1)];
    const int64_t at = upper ? a + step : c - step;
    const bool further =
        CodePlain(coder, StateAt(&row, 1 + near, far - near), (value >= at) == upper);
    (further == upper ? a : c) = at;
    if (!further) break;
    near = far;
  }
  if (c - a > 1) {
    const double middle = std::sqrt(near * far);
    const int64_t at = a + (c - a) / 2;
    Row& row = nearer_half_[side][std::min(octave, kOctaves - 1)];
    const bool nearer =
        CodePlain(coder, StateAt(&row, (middle - near) * (1 + far), (far - middle) * (1 + near)),
                  (value < at) == upper);
    (nearer == upper ? c : a) = at;
  }
  while (c - a > 1) {
    const int64_t at = a + (c - a) / 2;
    (coder.Code(32768, value >= at) ? a : c) = at;
  }
  return static_cast<int32_t>(a);
}

}  // namespace folprom
