// Small meshes, most of them chosen to be hard.
#pragma once

#include <string>
#include <vector>

#include "tests/support/mesh.h"
#include "tests/support/ply.h"

namespace folprom::support {

/// A mesh with the way in which it is stored and coded.
struct SmallMesh {
  std::string name;
  Mesh (*make)();
  CoordinateType type = CoordinateType::kFloat;
  uint32_t bits = 16;
  /// false: positions lie nearer to each other than the tolerance, so that a decoded mesh cannot be
  /// matched with the original by its positions.
  bool positions_tell = true;
};

/// Every topology and geometry that the coder promises not to refuse.
const std::vector<SmallMesh>& SmallMeshes();

/// `faces` random triples of distinct vertices among `vertices` random points.
Mesh RandomFaces(uint64_t vertices, uint64_t faces, uint64_t seed);

/// Random faces with copies, opposite copies, degenerate faces, isolated and coincident vertices.
Mesh NonManifoldSoup(uint64_t vertices, uint64_t faces, uint64_t seed);

}  // namespace folprom::support
