// What vertices have beside their position, and faces beside their corners.
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
  double step = 0;  ///< above 0: its values are rounded to multiples of this behind the least one
};

struct FaceAttributeInfo {
  std::string name;
  ScalarType type = ScalarType::kUint8;
  uint32_t per_corner = 0;  ///< 0: one number a face; else so many for each of its corners
};

/// Values of the faces of a whole mesh.
struct DecodedFaceAttribute {
  std::string name;
  ScalarType type = ScalarType::kUint8;
  uint32_t per_corner = 0;  ///< as in FaceAttributeInfo
  /// Triangle by triangle (a polygon's share its numbers), in that the corners one after another,
  /// lowest byte first, every bit kept.
  std::vector<uint8_t> values;
};

/// Values of the vertices of a mesh.
struct DecodedAttribute {
  std::string name;
  ScalarType type = ScalarType::kUint8;
  std::vector<uint8_t> values;  ///< vertex by vertex, lowest byte first, every bit kept
};

}  // namespace folprom
