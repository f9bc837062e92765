// A fingerprint of a mesh that does not depend on the order of its vertices and faces.
#pragma once

#include <cstdint>
#include <span>

#include "engine/mesh/exact_lattice.h"
#include "engine/mesh/types.h"
#include "io/container/file_table.h"

namespace folprom {

/// Adds one vertex at a lattice position.
void AddVertex(io::MeshDigest* digest, const Int3& position);
/// Adds one face by its corners' positions; the same for every rotation, not for a reflection.
void AddFace(io::MeshDigest* digest, Int3 a, Int3 b, Int3 c);

/// The same over the bits of exact positions.
void AddVertex(io::MeshDigest* digest, const ExactPosition& position);
void AddFace(io::MeshDigest* digest, const ExactPosition& a, const ExactPosition& b,
             const ExactPosition& c);

/// Adds vertices with their attributes, vertex by vertex as the file has them; none: as above.
void AddVertices(io::MeshDigest* digest, std::span<const Int3> positions,
                 std::span<const uint8_t> attributes);
void AddVertices(io::MeshDigest* digest, std::span<const ExactPosition> positions,
                 std::span<const uint8_t> attributes);

}  // namespace folprom
