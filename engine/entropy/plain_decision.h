// A binary decision under one context that learns: a look-up, a shift and an addition, where a
// MixedModel would cost too much. Its states are those of a MixedModel.
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "engine/entropy/bit_coder.h"
#include "engine/entropy/mixed_model.h"

namespace folprom {

/// A probability in the upper 22 bits and a count of decisions in the lower 10.
using PlainState = uint32_t;

/// Counts what decisions would cost; no model learns from them.
class TrialCoder {
 public:
  static constexpr bool kEncoding = true;
  bool Code(uint32_t one_in_65536, bool bit) {
    cost_ += detail::kCost[(bit ? one_in_65536 : 65536 - one_in_65536) >> 4];
    return bit;
  }
  void SetMeter(uint64_t*) {}
  /// In 1/1024 bit.
  uint64_t cost() const { return cost_; }

 private:
  uint64_t cost_ = 0;
};

template <class Coder>
inline constexpr bool kLearns = !std::is_same_v<Coder, TrialCoder>;

/// The state that holds `true` to be so likely and gives it up as slowly as after `seen` decisions.
inline PlainState PlainStateOf(double probability, uint32_t seen) {
  constexpr double kLeast = 1.0 / 1024;
  const double bounded = std::clamp(probability, kLeast, 1 - kLeast);
  return static_cast<uint32_t>(bounded * (1 << 22)) << 10 | seen;
}

inline constexpr PlainState kEvenState = PlainState{1} << 31;

/// Codes `bit` and learns.
template <class Coder>
bool CodePlain(Coder& coder, PlainState* state, bool bit) {
  constexpr uint32_t kMostSeen = 250, kLeast = 32;
  const uint32_t now = *state;
  bit = coder.Code(std::clamp(now >> 16, kLeast, 65536 - kLeast), bit);
  if constexpr (!kLearns<Coder>) return bit;
  const uint32_t count = now & 1023;
  const auto probability = static_cast<int32_t>(now >> 10);
  const int64_t miss = (bit ? (1 << 22) - 1 : 0) - probability;
  const auto moved = probability + static_cast<int32_t>((miss * detail::kRate[count]) >> 16);
  *state = static_cast<uint32_t>(moved) << 10 | (count < kMostSeen ? count + 1 : count);
  return bit;
}

}  // namespace folprom
