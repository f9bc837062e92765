// Integers as a few modelled decisions: octave in unary, then the leading bits below it.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "engine/entropy/mixed_model.h"
#include "folprom/result.h"

namespace folprom {

/// Codes integers under N contexts. Small values are learnt one by one, large ones by their octave.
template <size_t N>
class IntegerModel {
 public:
  explicit IntegerModel(std::array<uint32_t, N> sizes) : decisions_(Scaled(sizes), kSlots) {}

  /// Unsigned value below 2^32 - 1.
  template <class Coder>
  uint32_t CodeUnsigned(Coder& coder, const std::array<uint32_t, N>& contexts, uint32_t value) {
    uint64_t shifted = uint64_t{value} + 1;
    uint32_t octave = static_cast<uint32_t>(std::bit_width(shifted)) - 1;
    uint32_t coded = 0;
    while (coded < kMaxOctave) {
      if (!Decide(coder, contexts, coded, octave > coded)) break;
      ++coded;
    }
    uint64_t result = 1;
    for (uint32_t i = 0; i < coded; ++i) {
      bool bit = (shifted >> (coded - 1 - i)) & 1;
      if (i < 2) {
        // Slot by octave and the bits so far of this value.
        uint32_t prefix = i == 0 ? 0 : 1 + static_cast<uint32_t>(result & 1);
        uint32_t slot = kMaxOctave + (coded < 12 ? coded : 12) * 3 + prefix;
        bit = Decide(coder, contexts, slot, bit);
      } else {
        bit = coder.Code(32768, bit);
      }
      result = result << 1 | static_cast<uint64_t>(bit);
    }
    return static_cast<uint32_t>(result - 1);
  }

  /// Signed value of size below 2^31 - 1.
  template <class Coder>
  int32_t CodeSigned(Coder& coder, const std::array<uint32_t, N>& contexts, int32_t value) {
    if (!Decide(coder, contexts, kZeroSlot, value != 0)) return 0;
    bool negative = Decide(coder, contexts, kSignSlot, value < 0);
    // A decoder may pass anything as `value`, so it is negated as an unsigned number.
    uint32_t size = static_cast<uint32_t>(value);
    size = CodeUnsigned(coder, contexts, (value < 0 ? 0U - size : size) - 1);
    if (size >= 0x7ffffffe) throw Failure(ErrorKind::kCorrupt, "coded integer out of range");
    int32_t result = static_cast<int32_t>(size) + 1;
    return negative ? -result : result;
  }

 private:
  static constexpr uint32_t kMaxOctave = 31;
  static constexpr uint32_t kZeroSlot = kMaxOctave + 13 * 3;
  static constexpr uint32_t kSignSlot = kZeroSlot + 1;
  static constexpr uint32_t kSlots = kSignSlot + 1;

  static std::array<uint32_t, N> Scaled(std::array<uint32_t, N> sizes) {
    for (uint32_t& size : sizes) size *= kSlots;
    return sizes;
  }
  template <class Coder>
  bool Decide(Coder& coder, const std::array<uint32_t, N>& contexts, uint32_t slot, bool bit) {
    std::array<uint32_t, N> scaled;
    for (size_t i = 0; i < N; ++i) scaled[i] = contexts[i] * kSlots + slot;
    return decisions_.Code(coder, scaled, slot, bit);
  }

  MixedModel<N> decisions_;
};

}  // namespace folprom
