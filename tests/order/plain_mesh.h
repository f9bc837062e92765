// Reads mesh files into plain arrays without any code of the project.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace folprom::support {

/// The arrays of a file, element by element.
struct PlainMesh {
  /// All properties of the vertices, binary and lowest byte first, vertex by vertex.
  std::vector<std::string> vertices;
  std::vector<std::vector<int64_t>> faces;
  /// PLY: of each face its scalars, then its other lists without their counts, as bytes; each with
  /// the order of its properties.
  std::vector<std::string> face_scalars;
  std::vector<std::vector<std::string>> face_lists;
};

/// PLY in all three forms: scalar properties of the vertices, and all of the faces. OBJ,
/// OFF and binary STL: float32 x, y, z. Throws std::runtime_error.
PlainMesh ReadPlain(const std::string& path);

/// With each face turned so that it is least, and the faces sorted: what is the same where the
/// order of faces, and the corner that each begins with, do not count.
std::vector<std::vector<int64_t>> FacesAsSet(std::vector<std::vector<int64_t>> faces);

}  // namespace folprom::support
