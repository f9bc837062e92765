// Surfaces of any size.
#pragma once

#include <cstdint>

#include "tests/support/mesh.h"

namespace folprom::support {

/// A sphere with relief of several scales, about `vertices` vertices, irregularly sampled. With
/// `holes` some discs of faces are missing (their vertices stay, isolated).
Mesh BumpySphere(uint64_t vertices, bool holes, uint64_t seed);

/// A torus of columns x rows vertices.
Mesh Torus(uint64_t columns, uint64_t rows);

/// columns x rows vertices over the unit square, at height 0.
Mesh FlatGrid(uint64_t columns, uint64_t rows);

/// A height field of columns x rows vertices made with integers only: the same on every machine.
Mesh IntegerTerrain(uint64_t columns, uint64_t rows, uint64_t seed);

/// The same with two of each vertex's three coordinates on multiples of 1,000, as on a surface that
/// is cut out of voxels.
Mesh VoxelTerrain(uint64_t columns, uint64_t rows, uint64_t seed);

/// An integer terrain whose faces were each cut into four, at the middles of the edges.
Mesh SubdividedTerrain(uint64_t columns, uint64_t rows, uint64_t seed);

/// A depth image of columns x rows pixels made with integers only: smooth, with noise in the depth,
/// a jump in the middle that no face spans, holes and lost pixels. Every vertex has a face.
Mesh RangeGrid(uint64_t columns, uint64_t rows, uint64_t seed);

}  // namespace folprom::support
