// Integers near a prediction that is a real number: each decision halves the interval that is left,
// and a density around the prediction says how likely each half is, beside contexts that learn.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/entropy/axis_density.h"
#include "engine/entropy/mixed_model.h"
#include "engine/entropy/plane_window.h"

namespace folprom {

namespace detail {

/// 2^x for |x| <= 60, relative error below 1e-4.
inline double FastExp2(double x) {
  double whole = std::floor(x), f = x - whole;
  double value = 1 + f * (0.69314718 +
                          f * (0.24022651 + f * (0.05550410 + f * (0.00961812 + f * 0.00133336))));
  return value *
         std::bit_cast<double>(static_cast<uint64_t>(1023 + static_cast<int64_t>(whole)) << 52);
}

/// ln(x) for normal x > 0, absolute error below 1e-4.
inline double FastLog(double x) {
  uint64_t bits = std::bit_cast<uint64_t>(x);
  double exponent = static_cast<double>(static_cast<int64_t>(bits >> 52) - 1023);
  double m = std::bit_cast<double>((bits & 0xfffffffffffffULL) | 0x3ff0000000000000ULL);
  double y = (m - 1) / (m + 1), s = y * y;
  return exponent * 0.69314718 + 2 * y * (1 + s * (0.33333333 + s * (0.2 + s * 0.14285714)));
}

/// The binary logarithm of a / b, both above 0, in parts of octaves: a line from each power of 2 to
/// the next stands for that of either.
template <int kPartBits>
inline int64_t RoughLog2(double a, double b) {
  return static_cast<int64_t>(std::bit_cast<uint64_t>(a) - std::bit_cast<uint64_t>(b)) >>
         (52 - kPartBits);
}

/// e^((at - mean) / scale), bounded: what LogisticOdds wants of a logistic density at an end.
inline double LogisticPower(double at, double mean, double scale) {
  return FastExp2(1.44269504 * std::clamp((at - mean) / scale, -40.0, 40.0));
}

/// Part of a density that is never impossible.
inline constexpr double kLeastPart = 1e-17;

/// ln(high / low) in 1/256.
inline int32_t LogOdds(double high, double low) {
  return static_cast<int32_t>(std::clamp(256 * FastLog(high / low), -2047.0, 2047.0));
}
/// ln of the odds of [here, last) against [first, here), in 1/256, of a logistic density, by the
/// powers at these ends. Between powers f and g lies (g - f) / ((1 + f) (1 + g)) of it.
inline int32_t LogisticOdds(double first, double here, double last) {
  const double from = 1 + first, to = 1 + last;
  const double least = kLeastPart * from * (1 + here) * to;
  return LogOdds(std::max((last - here) * from, least), std::max((here - first) * to, least));
}

}  // namespace detail

/// A prediction in units of cells: cell k covers [k, k + 1).
struct CellPrediction {
  double mean = 0;
  double scale = 1;  ///< of a logistic density, > 0
};

/// A density on the line of which cell k covers [k, k + 1) * cell - origin.
struct CellDensity {
  const AxisDensity* axis = nullptr;  ///< null: says nothing
  double origin = 0;
  double cell = 1;
  const PlaneWindow* planes = nullptr;  ///< cells of other weight; null: none

  bool tells() const { return axis != nullptr || planes != nullptr; }
  /// What lies below cell k, all cells of the same weight; where nothing was measured, of a
  /// logistic density whose power there is given.
  double Below(int64_t k, double power) const {
    if (axis == nullptr) return power / (1 + power);
    return axis->Below(cell * static_cast<double>(k) - origin);
  }
};

/// What may have the last word on which cells a coordinate is in: this has none.
struct NoWordOnCells {
  uint32_t Weigh(int64_t, uint32_t probability) const { return probability; }
  void Learn(bool) const {}
};

/// Mean size of what predictions miss by, per context, in a unit that the caller chooses.
class ScaleTable {
 public:
  explicit ScaleTable(uint32_t contexts, double first) : entries_(contexts, {first, 0}) {}
  double Of(uint32_t context) const { return entries_[context].mean; }
  void Learn(uint32_t context, double size) {
    LearnedScale& entry = entries_[context];
    if (entry.count < 200) entry.count = entry.count + 1;
    entry.mean = entry.mean + (size - entry.mean) / (entry.count + 3);
  }

  void Visit(LearnedStateVisitor& visitor) { visitor.Scales(entries_); }

 private:
  std::vector<LearnedScale> entries_;
};

/// N contexts, P predictions and, where M is 1, a density that the caller may have measured.
template <size_t N, size_t P, size_t M = 0>
class CellModel {
 public:
  /// Decisions that a context tells apart: side, octave of the distance, first halving inside it,
  /// all further ones.
  static constexpr uint32_t kOctaves = 10;
  static constexpr uint32_t kSlots = 1 + 2 * kOctaves + 2 * kOctaves + 1;

  explicit CellModel(std::array<uint32_t, N> sizes, uint32_t mixers = 1, bool on_planes = false)
      : decisions_(Scaled(sizes, on_planes), on_planes ? 4 * kSlots : kSlots, mixers) {}

  /// Codes value in [lo, hi]. Decisions that the range makes certain cost nothing. word: has the
  /// last one on each.
  template <class Coder, class Word = NoWordOnCells>
  int32_t Code(Coder& coder, const std::array<uint32_t, N>& contexts,
               const std::array<CellPrediction, P>& predictions, int32_t lo, int32_t hi,
               int32_t value, const CellDensity& density = {}, Word&& word = {}) {
    int64_t a = lo, c = int64_t{hi} + 1;
    double middle =
        std::clamp(predictions[0].mean, static_cast<double>(lo), static_cast<double>(hi));
    int64_t base = static_cast<int64_t>(middle);
    Interval interval{a, c, EndAt(predictions, density, a), EndAt(predictions, density, c),
                      &density};
    bool upper = Decide(coder, contexts, predictions, 0, base + 1, value, word, &interval);
    uint32_t octave = 0;
    int64_t step = 1;
    // Groups of 1, 2, 4 .. cells away from the base.
    while (interval.c - interval.a > 1) {
      int64_t at = upper ? interval.a + step : interval.c - step;
      if (at <= interval.a || at >= interval.c) break;
      uint32_t slot = 1 + (upper ? kOctaves : 0) + std::min(octave, kOctaves - 1);
      bool further =
          Decide(coder, contexts, predictions, slot, at, value, word, &interval) == upper;
      if (!further) break;
      ++octave;
      step = step * 2;
    }
    uint32_t slot = 1 + 2 * kOctaves + (upper ? kOctaves : 0) + std::min(octave, kOctaves - 1);
    while (interval.c - interval.a > 1) {
      int64_t at = interval.a + (interval.c - interval.a) / 2;
      Decide(coder, contexts, predictions, slot, at, value, word, &interval);
      slot = kSlots - 1;
    }
    return static_cast<int32_t>(interval.a);
  }

  void Visit(LearnedStateVisitor& visitor) { decisions_.Visit(visitor); }

 private:
  /// Where decisions part cells: of each logistic density e^((at - mean) / scale), and what of the
  /// measured one lies below.
  struct End {
    std::array<double, P> power;
    double below;
  };
  /// What is left: cells [a, c).
  struct Interval {
    int64_t a, c;
    End first, last;
    const CellDensity* density;
  };

  template <class Word>
  struct LastWord {
    Word& word;
    int64_t at;
    uint32_t Weigh(uint32_t probability) { return word.Weigh(at, probability); }
    void Learn(bool upper) { word.Learn(upper); }
  };

  static std::array<uint32_t, N> Scaled(std::array<uint32_t, N> sizes, bool on_planes) {
    for (uint32_t& size : sizes) size *= kSlots;
    if (on_planes) sizes[N - 1] *= 4;
    return sizes;
  }
  static End EndAt(const std::array<CellPrediction, P>& predictions, const CellDensity& density,
                   int64_t at) {
    End end{{}, 0};
    for (size_t p = 0; p < P; ++p) {
      end.power[p] =
          detail::LogisticPower(static_cast<double>(at), predictions[p].mean, predictions[p].scale);
    }
    if (M > 0 && density.tells()) {
      const double below = density.Below(at, end.power[0]);
      end.below = density.planes != nullptr ? density.planes->Weighted(at, below) : below;
    }
    return end;
  }

  /// Is value >= at; narrows the interval.
  template <class Coder, class Word>
  bool Decide(Coder& coder, const std::array<uint32_t, N>& contexts,
              const std::array<CellPrediction, P>& predictions, uint32_t slot, int64_t at,
              int32_t value, Word& word, Interval* interval) {
    if (at <= interval->a) return true;
    if (at >= interval->c) return false;
    const End here = EndAt(predictions, *interval->density, at);
    const End &first = interval->first, &last = interval->last;
    std::array<int32_t, P + M> inputs{};
    for (size_t p = 0; p < P; ++p) {
      inputs[p] = detail::LogisticOdds(first.power[p], here.power[p], last.power[p]);
    }
    if (M > 0 && interval->density->tells()) {
      inputs[P + M - 1] = detail::LogOdds(std::max(last.below - here.below, detail::kLeastPart),
                                          std::max(here.below - first.below, detail::kLeastPart));
    }
    std::array<uint32_t, N> scaled;
    for (size_t i = 0; i < N; ++i) scaled[i] = contexts[i] * kSlots + slot;
    uint32_t set = slot;
    if (M > 0 && interval->density->planes != nullptr) {
      const PlaneWindow& planes = *interval->density->planes;
      set =
          slot * 4 + (planes.Any(interval->a, at) ? 2 : 0) + (planes.Any(at, interval->c) ? 1 : 0);
      scaled[N - 1] = scaled[N - 1] * 4 + set % 4;
    }
    bool upper = decisions_.Code(coder, scaled, set, value >= at, inputs, LastWord<Word>{word, at});
    if (upper) {
      interval->a = at;
      interval->first = here;
    } else {
      interval->c = at;
      interval->last = here;
    }
    return upper;
  }

  MixedModel<N, P + M> decisions_;
};

}  // namespace folprom
