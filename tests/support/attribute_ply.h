// PLY files whose vertices have attributes, read and written without any code of the project.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/mesh.h"

namespace folprom::support {

/// A mesh with its attributes and where they stand in the file.
struct AttributeMesh {
  Mesh mesh;                          ///< with attributes; positions are doubles in the file
  size_t before_position = 0;         ///< attributes before x, y, z
  std::vector<std::string> comments;  ///< whole lines
};

/// Binary little-endian.
void WriteAttributes(const std::string& path, const AttributeMesh& content);
/// Of such a file, or one whose coordinates are floats. Throws std::runtime_error on anything else.
AttributeMesh ReadAttributes(const std::string& path);

/// Appends a value.
template <class T>
void AppendValue(T value, DecodedAttribute* attribute) {
  const auto* bytes = reinterpret_cast<const uint8_t*>(&value);
  attribute->values.insert(attribute->values.end(), bytes, bytes + sizeof value);
}

/// Each vertex as the bytes of its position and attributes, sorted.
std::vector<std::string> SortedVertices(const Mesh& mesh);
/// The attributes alone, vertex by vertex.
std::vector<std::string> AttributeRows(const Mesh& mesh);

/// An attribute of each of the eight types with values that a careless coder loses: both ends of
/// the range, -0.0, infinities, NaN with payloads, the smallest numbers; most of them smooth.
std::vector<DecodedAttribute> EveryType(const Mesh& mesh, uint64_t seed);
/// red, green, blue and alpha as a scan has them, made with integers only.
std::vector<DecodedAttribute> Colours(const Mesh& mesh, uint64_t seed);

}  // namespace folprom::support
