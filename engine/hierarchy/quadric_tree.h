// Bottom-up hierarchy: half-edge contraction in order of quadric error.
#pragma once

#include <cstdint>
#include <span>

#include "engine/hierarchy/set_tree.h"
#include "engine/mesh/types.h"
#include "folprom/settings.h"

namespace folprom {

/// A binary tree: the first child of a set keeps its representative, an original vertex.
/// Contractions minimise the quadric error (Garland and Heckbert, "Surface Simplification Using
/// Quadric Error Metrics", 1997) plus a length term that keeps rings regular. Any topology;
/// vertices that no edge joins are joined last, nearest in space first. `subtree` is the number by
/// which cross faces refer to these vertices. At least one vertex. Single-threaded and the same on
/// every machine.
SetTree BuildQuadricTree(std::span<const Int3> positions, std::span<const Face> faces,
                         std::span<const CrossFace> cross_faces, uint32_t subtree,
                         const CodecSettings& settings);

}  // namespace folprom
