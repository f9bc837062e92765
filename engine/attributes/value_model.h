// Values near a prediction: decisions halve the interval that is left, and densities around the
// predictions say how likely each half is, beside contexts that learn. As CellModel, but for whole
// numbers of 64 bits that stand for reals unevenly, as floats do.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/attributes/value.h"
#include "engine/entropy/cell_model.h"
#include "engine/entropy/mixed_model.h"

namespace folprom {

/// The values an attribute can have.
struct ValueSpan {
  ScalarType type = ScalarType::kUint8;
  uint64_t least = 0, most = 0;  ///< ordered, most >= least
  /// 1, 2, 3: it is the x, y, z of the normal of the surface; 0: of nothing that is known.
  uint32_t normal_axis = 0;
  /// Above 0: the ordered numbers are the k of first + k step, to which the floats are rounded.
  double step = 0, first = 0;
};

/// The real value of an ordered number.
inline double RealOf(const ValueSpan& span, uint64_t ordered) {
  if (span.step > 0) return span.first + span.step * static_cast<double>(ordered);
  return RealOf(span.type, ordered);
}
/// A real number between the values before `ordered` and at it.
inline double BoundaryBelow(const ValueSpan& span, uint64_t ordered) {
  if (span.step > 0) return span.first + span.step * (static_cast<double>(ordered) - 0.5);
  return BoundaryBelow(span.type, ordered);
}
/// The ordered number nearest to a finite real one.
inline uint64_t NearestOrdered(const ValueSpan& span, double real) {
  if (span.step > 0) {
    const double k = (real - span.first) / span.step + 0.5;
    return static_cast<uint64_t>(std::clamp(k, 0.0, static_cast<double>(span.most)));
  }
  return NearestOrdered(span.type, real);
}
/// Of the value stored at `bytes`.
inline uint64_t OrderedOf(const ValueSpan& span, const uint8_t* bytes) {
  const uint64_t ordered = OrderedOf(span.type, bytes);
  return span.step > 0 ? NearestOrdered(span, RealOf(span.type, ordered)) : ordered;
}
/// Stores the value; returns where the next one goes.
inline uint8_t* StoreOrdered(const ValueSpan& span, uint64_t ordered, uint8_t* bytes) {
  if (span.step > 0) ordered = NearestOrdered(span.type, RealOf(span, ordered));
  return StoreOrdered(span.type, ordered, bytes);
}

/// A logistic density over the real value.
struct ValuePrediction {
  double mean = 0;   ///< at most 1e300 in size
  double scale = 1;  ///< > 0
};

/// N contexts, P predictions. The first prediction is where the search begins.
template <size_t N, size_t P>
class ValueModel {
 public:
  explicit ValueModel(std::array<uint32_t, N> sizes) : decisions_(Scaled(sizes), kSlots) {}

  /// Codes a value of the span; decisions that the span makes certain cost nothing.
  template <class Coder>
  uint64_t Code(Coder& coder, const std::array<uint32_t, N>& contexts,
                const std::array<ValuePrediction, P>& predictions, const ValueSpan& span,
                uint64_t value) {
    Search<Coder> search{coder, contexts, predictions, span, value, span.least, span.most, {}, {}};
    search.below.fill(detail::LogisticPower(-1e300, 0, 1));
    search.above.fill(detail::LogisticPower(1e300, 0, 1));
    const uint64_t base =
        std::clamp(NearestOrdered(span, predictions[0].mean), span.least, span.most);
    const uint32_t grain = GrainOf(predictions[0], span, base);
    const bool upper = base < span.most && Decide(search, 0, base + 1);
    // Groups of 1, 2, 4 .. grains away from the base.
    uint32_t octave = 0;
    for (uint32_t shift = grain; shift < 64; ++shift, ++octave) {
      const uint64_t step = uint64_t{1} << shift;
      if (search.last - search.first < step) break;
      const uint64_t at = upper ? search.first + step : search.last - step + 1;
      const uint32_t slot = 1 + (upper ? kOctaves : 0) + std::min(octave, kOctaves - 1);
      if (Decide(search, slot, at) != upper) break;
    }
    uint32_t slot = 1 + 2 * kOctaves + (upper ? kOctaves : 0) + std::min(octave, kOctaves - 1);
    const uint64_t flat = grain > kFlatBits ? (uint64_t{1} << (grain - kFlatBits)) - 1 : 0;
    while (search.last - search.first > flat) {
      Decide(search, slot, search.first + (search.last - search.first) / 2 + 1);
      slot = kSlots - 1;
    }
    while (search.last > search.first) {
      const uint64_t at = search.first + (search.last - search.first) / 2 + 1;
      if (coder.Code(32768, value >= at)) {
        search.first = at;
      } else {
        search.last = at - 1;
      }
    }
    return search.first;
  }

 private:
  static constexpr uint32_t kOctaves = 8;
  /// Which side, octave of the distance, first halving inside it, all further ones.
  static constexpr uint32_t kSlots = 1 + 2 * kOctaves + 2 * kOctaves + 1;
  /// Inside an interval of a grain less so many bits no value is likelier than others.
  static constexpr uint32_t kFlatBits = 2;

  /// Of each density at a boundary between values: LogisticPower.
  using Powers = std::array<double, P>;
  template <class Coder>
  struct Search {
    Coder& coder;
    const std::array<uint32_t, N>& contexts;
    const std::array<ValuePrediction, P>& predictions;
    const ValueSpan& span;
    uint64_t value;
    uint64_t first, last;  ///< what is left
    Powers below, above;   ///< at the ends of that
  };

  static std::array<uint32_t, N> Scaled(std::array<uint32_t, N> sizes) {
    for (uint32_t& size : sizes) size *= kSlots;
    return sizes;
  }

  /// Octave of the distance, in values, that is a quarter of the scale at the base.
  static uint32_t GrainOf(const ValuePrediction& prediction, const ValueSpan& span, uint64_t base) {
    const double quarter = prediction.scale / 4;
    uint64_t distance = 0;
    if (span.step > 0) {
      distance = static_cast<uint64_t>(std::clamp(quarter / span.step, 0.0, 4294967295.0));
    } else if (IsFloat(span.type)) {
      const uint64_t up = NearestOrdered(span.type, prediction.mean + quarter);
      const uint64_t down = NearestOrdered(span.type, prediction.mean - quarter);
      distance = std::min(up > base ? up - base : 0, base > down ? base - down : 0);
    } else {
      distance = static_cast<uint64_t>(std::clamp(quarter, 0.0, 4294967295.0));
    }
    return distance == 0 ? 0 : static_cast<uint32_t>(std::bit_width(distance)) - 1;
  }

  /// Is the value >= at; narrows what is left, which has a value on either side.
  template <class Coder>
  bool Decide(Search<Coder>& search, uint32_t slot, uint64_t at) {
    Powers here;
    std::array<int32_t, P> inputs;
    const double boundary = BoundaryBelow(search.span, at);
    for (size_t p = 0; p < P; ++p) {
      const ValuePrediction& prediction = search.predictions[p];
      here[p] = detail::LogisticPower(boundary, prediction.mean, prediction.scale);
      inputs[p] = detail::LogisticOdds(search.below[p], here[p], search.above[p]);
    }
    std::array<uint32_t, N> scaled;
    for (size_t i = 0; i < N; ++i) scaled[i] = search.contexts[i] * kSlots + slot;
    const bool upper = decisions_.Code(search.coder, scaled, slot, search.value >= at, inputs);
    if (upper) {
      search.first = at;
      search.below = here;
    } else {
      search.last = at - 1;
      search.above = here;
    }
    return upper;
  }

  MixedModel<N, P> decisions_;
};

}  // namespace folprom
