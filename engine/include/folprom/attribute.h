// What vertices have beside their position.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "folprom/scalar_type.h"

namespace folprom {

struct AttributeInfo {
  std::string name;
  ScalarType type = ScalarType::kUint8;
  double bits = 0;  ///< spent on it over the whole file, without its value at each subtree's root
};

/// Values of the vertices of a mesh.
struct DecodedAttribute {
  std::string name;
  ScalarType type = ScalarType::kUint8;
  std::vector<uint8_t> values;  ///< vertex by vertex, lowest byte first, every bit kept
};

}  // namespace folprom
