// Reads and writes binary PLY without any code of the project.
#pragma once

#include <string>

#include "tests/support/mesh.h"

namespace folprom::support {

enum class CoordinateType { kShort, kInt, kFloat, kDouble };

/// Binary little-endian, `property list uchar int vertex_indices`. Coordinates are rounded to the
/// type; ReadPly tells the result.
void WritePly(const std::string& path, const Mesh& mesh, CoordinateType type);

/// Faces as a binary little-endian PLY holds them, `property list uchar int`.
std::string FaceBytes(const Mesh& mesh);

struct PlyContent {
  Mesh mesh;
  std::string coordinate_type;  ///< as spelt in the header
};

/// A binary little-endian PLY of vertices with scalar properties and triangles. Throws
/// std::runtime_error on anything else, on an index beyond the vertices and on bytes left over.
PlyContent ReadPly(const std::string& path);

}  // namespace folprom::support
