// Takes values of a PLY file as they are kept, with either cursor.
#pragma once

#include <concepts>
#include <cstdint>

#include "folprom/float_bits.h"
#include "io/formats/ply_scalar.h"
#include "io/formats/store_bytes.h"

namespace folprom::io {

/// Values as bytes, lowest first. Real widens a float with its bits, and checks the range of an
/// integer, which a double holds.
template <class Cursor>
uint8_t* ReadValue(Cursor& cursor, ScalarType type, uint8_t* to) {
  return WithScalarType(type, [&]<class T>(T) {
    if constexpr (std::same_as<T, float>) {
      return StoreLittleEndian(NarrowToFloatBits(cursor.Real(ScalarType::kFloat32)), to);
    } else if constexpr (std::same_as<T, double>) {
      return StoreLittleEndian(cursor.Real(ScalarType::kFloat64), to);
    } else {
      return StoreLittleEndian(static_cast<T>(cursor.Real(type)), to);
    }
  });
}

}  // namespace folprom::io
