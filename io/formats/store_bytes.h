// Puts values into binary files.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

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

}  // namespace folprom::io
