// Between float and double, bit for bit: conversions by the processor make a signalling NaN quiet.
#pragma once

#include <bit>
#include <cstdint>

namespace folprom {

/// The double of the same value. A NaN keeps its sign, its quiet bit and its payload.
inline double WidenFloat(float value) {
  if (value == value) return static_cast<double>(value);
  const auto bits = std::bit_cast<uint32_t>(value);
  return std::bit_cast<double>(uint64_t{bits >> 31} << 63 | uint64_t{0x7ff} << 52 |
                               uint64_t{bits & 0x7fffff} << 29);
}

/// The nearest float, as its bits; gives back what WidenFloat was given, whatever that was.
inline uint32_t NarrowToFloatBits(double value) {
  if (value == value) return std::bit_cast<uint32_t>(static_cast<float>(value));
  const auto bits = std::bit_cast<uint64_t>(value);
  const auto payload = static_cast<uint32_t>(bits >> 29 & 0x7fffff);
  // The payload of a double may lie below what a float holds: it stays a NaN.
  return static_cast<uint32_t>(bits >> 63) << 31 | 0x7f800000u |
         (payload == 0 ? 1u << 22 : payload);
}

}  // namespace folprom
