// Puts values into binary files.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "folprom/float_bits.h"
#include "folprom/scalar_type.h"

namespace folprom::io {

/// Stores the value little-endian; returns where the next one goes.
template <class T>
uint8_t* StoreLittleEndian(T value, uint8_t* to) {
  const auto bytes = std::bit_cast<std::array<uint8_t, sizeof(T)>>(value);
  if constexpr (std::endian::native == std::endian::little) {
    return std::copy(bytes.begin(), bytes.end(), to);
  } else {
    return std::copy(bytes.rbegin(), bytes.rend(), to);
  }
}

/// The same of a value as float32 or float64.
inline uint8_t* StoreReal(ScalarType type, double value, uint8_t* to) {
  if (type == ScalarType::kFloat64) return StoreLittleEndian(value, to);
  return StoreLittleEndian(NarrowToFloatBits(value), to);
}

}  // namespace folprom::io
