// The eight types that a number of a file can have, by PLY's numbers of them.
#pragma once

#include <cstddef>
#include <cstdint>

namespace folprom {

enum class ScalarType : uint8_t {
  kInt8 = 0,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kFloat32,
  kFloat64
};
inline constexpr size_t kScalarTypes = 8;

/// "uint8", "float32" ...
constexpr const char* NameOf(ScalarType type) {
  constexpr const char* kNames[] = {"int8",  "uint8",  "int16",   "uint16",
                                    "int32", "uint32", "float32", "float64"};
  return kNames[static_cast<size_t>(type)];
}

/// In bytes.
constexpr size_t ScalarSize(ScalarType type) {
  constexpr size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<size_t>(type)];
}

constexpr bool IsFloat(ScalarType type) {
  return type == ScalarType::kFloat32 || type == ScalarType::kFloat64;
}

/// The values of a type as whole numbers in their order go from 0 to this.
constexpr uint64_t LargestOrdered(ScalarType type) {
  return ~uint64_t{0} >> (64 - 8 * ScalarSize(type));
}

}  // namespace folprom
