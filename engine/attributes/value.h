// Values of attributes as whole numbers whose order is that of the values, and as real numbers.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "folprom/scalar_type.h"

namespace folprom {

namespace detail {
constexpr uint64_t SignOf(ScalarType type) { return uint64_t{1} << (8 * ScalarSize(type) - 1); }
constexpr bool IsSigned(ScalarType type) {
  using enum ScalarType;
  return type == kInt8 || type == kInt16 || type == kInt32;
}
/// Of a float, as a double without infinities, 0 for a NaN.
template <class Float, class Bits>
double FiniteOf(uint64_t bits) {
  const auto value = static_cast<double>(std::bit_cast<Float>(static_cast<Bits>(bits)));
  if (!(value == value)) return 0;
  return std::clamp(value, -1e300, 1e300);
}
}  // namespace detail

/// Bijective: of floats negative ones are turned round, so NaN lie at both ends.
inline uint64_t OrderedFromBits(ScalarType type, uint64_t bits) {
  const uint64_t sign = detail::SignOf(type);
  if (detail::IsSigned(type)) return bits ^ sign;
  if (!IsFloat(type)) return bits;
  return (bits & sign) != 0 ? ~bits & LargestOrdered(type) : bits | sign;
}
inline uint64_t BitsFromOrdered(ScalarType type, uint64_t ordered) {
  const uint64_t sign = detail::SignOf(type);
  if (detail::IsSigned(type)) return ordered ^ sign;
  if (!IsFloat(type)) return ordered;
  return (ordered & sign) != 0 ? ordered ^ sign : ~ordered & LargestOrdered(type);
}

/// The value stored at `bytes`, lowest byte first.
inline uint64_t OrderedOf(ScalarType type, const uint8_t* bytes) {
  uint64_t bits = 0;
  for (size_t i = 0; i < ScalarSize(type); ++i) bits |= uint64_t{bytes[i]} << (8 * i);
  return OrderedFromBits(type, bits);
}
/// Stores the value; returns where the next one goes.
inline uint8_t* StoreOrdered(ScalarType type, uint64_t ordered, uint8_t* bytes) {
  const uint64_t bits = BitsFromOrdered(type, ordered);
  for (size_t i = 0; i < ScalarSize(type); ++i) *bytes++ = static_cast<uint8_t>(bits >> (8 * i));
  return bytes;
}

/// The value of a float, the ordered number itself of an integer. Finite, at most 1e300 in size;
/// 0 for a NaN.
inline double RealOf(ScalarType type, uint64_t ordered) {
  switch (type) {
    case ScalarType::kFloat32:
      return detail::FiniteOf<float, uint32_t>(BitsFromOrdered(type, ordered));
    case ScalarType::kFloat64:
      return detail::FiniteOf<double, uint64_t>(BitsFromOrdered(type, ordered));
    default:
      return static_cast<double>(ordered);
  }
}

/// A real number between the values before `ordered` and at it; never falls as that grows.
inline double BoundaryBelow(ScalarType type, uint64_t ordered) {
  if (!IsFloat(type)) return static_cast<double>(ordered) - 0.5;
  // Beyond the infinities are NaN.
  const uint64_t infinity = type == ScalarType::kFloat32 ? 0x7f800000u : 0x7ffULL << 52;
  const uint64_t sign = detail::SignOf(type);
  if (ordered > (infinity | sign)) return 1e300;
  if (ordered <= (~(infinity | sign) & LargestOrdered(type))) return -1e300;
  return (RealOf(type, ordered - 1) + RealOf(type, ordered)) / 2;
}

/// The ordered number nearest to a finite real one.
inline uint64_t NearestOrdered(ScalarType type, double real) {
  switch (type) {
    case ScalarType::kFloat32: {
      const double most = static_cast<double>(std::numeric_limits<float>::max());
      const auto value = static_cast<float>(std::clamp(real, -most, most));
      return OrderedFromBits(type, std::bit_cast<uint32_t>(value));
    }
    case ScalarType::kFloat64:
      return OrderedFromBits(type, std::bit_cast<uint64_t>(real));
    default:
      return static_cast<uint64_t>(
          std::clamp(real + 0.5, 0.0, static_cast<double>(LargestOrdered(type))));
  }
}

}  // namespace folprom
