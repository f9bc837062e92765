// The eight scalar types of PLY: their sizes, and loads from unaligned bytes of either order.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>

#include "folprom/float_bits.h"
#include "folprom/scalar_type.h"

namespace folprom::io {

/// Largest value of an unsigned type; 0 for the others.
constexpr uint64_t UnsignedMax(ScalarType type) {
  switch (type) {
    case ScalarType::kUint8:
      return UINT8_MAX;
    case ScalarType::kUint16:
      return UINT16_MAX;
    case ScalarType::kUint32:
      return UINT32_MAX;
    default:
      return 0;
  }
}

template <class T, bool kBigEndian>
T Load(const uint8_t* bytes) {
  if constexpr (kBigEndian == (std::endian::native == std::endian::big) || sizeof(T) == 1) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
  } else {
    uint8_t swapped[sizeof(T)];
    for (size_t i = 0; i < sizeof(T); ++i) swapped[i] = bytes[sizeof(T) - 1 - i];
    return std::bit_cast<T>(swapped);
  }
}

/// The same value; bit for bit also where a float is a NaN.
template <class T>
double ToDouble(T value) {
  if constexpr (std::same_as<T, float>) {
    return WidenFloat(value);
  } else {
    return static_cast<double>(value);
  }
}

/// Calls work(T{}) with the C++ type of `type`.
template <class Work>
decltype(auto) WithScalarType(ScalarType type, Work work) {
  switch (type) {
    case ScalarType::kInt8:
      return work(int8_t{});
    case ScalarType::kUint8:
      return work(uint8_t{});
    case ScalarType::kInt16:
      return work(int16_t{});
    case ScalarType::kUint16:
      return work(uint16_t{});
    case ScalarType::kInt32:
      return work(int32_t{});
    case ScalarType::kUint32:
      return work(uint32_t{});
    case ScalarType::kFloat32:
      return work(float{});
    case ScalarType::kFloat64:
      break;
  }
  return work(double{});
}

}  // namespace folprom::io
