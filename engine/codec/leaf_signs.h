// What an LOD tells of a set that may be a single vertex.
#pragma once

#include <cstdint>

#include "engine/codec/leaf_model.h"
#include "engine/codec/subtree_lod.h"

namespace folprom {

/// spacing: of the set now, lattice units.
LeafSigns LeafSignsOf(const SubtreeLod& lod, const SetStar& star, double spacing);

}  // namespace folprom
