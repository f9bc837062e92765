// Is a decoded mesh the original one: decided from the two meshes alone.
#pragma once

#include <string>

#include "tests/support/mesh.h"

namespace folprom::support {

/// Empty when the meshes agree, else what differs first. Each decoded vertex must lie within
/// `tolerance` per axis of exactly one position of the original, every position must be taken as
/// often as in the original, and faces must be the same up to rotation. Coincident vertices are
/// told apart by the faces around them, three rings far. Positions of the original must be equal or
/// more than twice the tolerance apart.
std::string DifferenceOf(const Mesh& original, const Mesh& decoded, double tolerance);

/// Equal positions in the same order, and the same faces in any order.
std::string DifferenceInOrder(const Mesh& a, const Mesh& b);

}  // namespace folprom::support
