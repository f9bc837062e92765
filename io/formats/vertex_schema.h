// What a mesh file has of each vertex beside its position, and the remarks in its header.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "folprom/scalar_type.h"

namespace folprom::io {

inline constexpr size_t kMostAttributes = 255;
inline constexpr size_t kLongestAttributeName = 255;             ///< bytes
inline constexpr uint64_t kMostSteps = (uint64_t{1} << 24) - 1;  ///< of a rounded attribute
inline constexpr size_t kMostRemarkBytes = size_t{16} << 20;     ///< of all lines together

/// A number that each vertex has.
struct VertexAttribute {
  std::string name;
  ScalarType type = ScalarType::kUint8;
  bool operator==(const VertexAttribute&) const = default;
};

struct VertexSchema {
  std::vector<VertexAttribute> attributes;  ///< in the order of the file
  size_t before_position = 0;               ///< so many of them stand before x, y, z

  /// Bytes of the attributes of a vertex.
  size_t Stride() const {
    size_t bytes = 0;
    for (const VertexAttribute& attribute : attributes) bytes += ScalarSize(attribute.type);
    return bytes;
  }
  bool operator==(const VertexSchema&) const = default;
};

/// Can stand in the header of a file: printable, no blank, not the name of a coordinate.
inline bool IsAttributeName(std::string_view name) {
  return !name.empty() && name.size() <= kLongestAttributeName && name != "x" && name != "y" &&
         name != "z" && std::ranges::all_of(name, [](char c) { return c >= '!' && c <= '~'; });
}

/// A line "comment ..." or "obj_info ..." that ends nowhere inside.
inline bool IsRemark(std::string_view line) {
  const size_t word = std::min(line.find_first_of(" \t"), line.size());
  const std::string_view first = line.substr(0, word);
  return (first == "comment" || first == "obj_info") &&
         line.find_first_of(std::string_view("\n\r\0", 3)) == std::string_view::npos;
}

/// Least and largest value of an attribute, as whole numbers in the order of the values; see
/// FORMAT.md.
struct AttributeRange {
  uint64_t least = 0;
  uint64_t most = 0;
  /// Above 0: floats that are rounded to first + k step; the range is that of the whole numbers k.
  double step = 0;
  double first = 0;
  bool operator==(const AttributeRange&) const = default;
};

}  // namespace folprom::io
