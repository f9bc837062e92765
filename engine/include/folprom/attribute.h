// What vertices have beside their position.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace folprom {

/// The eight scalar types of PLY, by its numbers of them.
enum class AttributeType : uint8_t {
  kInt8 = 0,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kFloat32,
  kFloat64
};

/// "uint8", "float32" ...
inline const char* NameOf(AttributeType type) {
  constexpr const char* kNames[] = {"int8",  "uint8",  "int16",   "uint16",
                                    "int32", "uint32", "float32", "float64"};
  return kNames[static_cast<size_t>(type)];
}

struct AttributeInfo {
  std::string name;
  AttributeType type = AttributeType::kUint8;
  double bits = 0;  ///< spent on it over the whole file, without its value at each subtree's root
};

/// Values of the vertices of a mesh.
struct DecodedAttribute {
  std::string name;
  AttributeType type = AttributeType::kUint8;
  std::vector<uint8_t> values;  ///< vertex by vertex, lowest byte first, every bit kept
};

}  // namespace folprom
