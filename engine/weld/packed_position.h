// The bits of a position, in as few words as its type has.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "folprom/float_bits.h"
#include "folprom/scalar_type.h"

namespace folprom {

/// Three words where a scan has floats, else six. Equal words are equal bits: -0.0 is not 0.0, and
/// a NaN is what has the same payload.
class PackedPosition {
 public:
  static constexpr size_t kMostWords = 6;

  explicit PackedPosition(ScalarType type) : is_float_(type == ScalarType::kFloat32) {}

  size_t words() const { return is_float_ ? 3 : kMostWords; }

  void Pack(const double* xyz, uint32_t* words) const {
    for (size_t axis = 0; axis < 3; ++axis) {
      if (is_float_) {
        words[axis] = NarrowToFloatBits(xyz[axis]);
      } else {
        const auto bits = std::bit_cast<uint64_t>(xyz[axis]);
        words[2 * axis] = static_cast<uint32_t>(bits);
        words[2 * axis + 1] = static_cast<uint32_t>(bits >> 32);
      }
    }
  }

  void Unpack(const uint32_t* words, double* xyz) const {
    for (size_t axis = 0; axis < 3; ++axis) {
      if (is_float_) {
        xyz[axis] = WidenFloat(std::bit_cast<float>(words[axis]));
      } else {
        xyz[axis] = std::bit_cast<double>(uint64_t{words[2 * axis + 1]} << 32 | words[2 * axis]);
      }
    }
  }

 private:
  bool is_float_;
};

}  // namespace folprom
