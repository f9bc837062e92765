#include "engine/codec/leaf_signs.h"

#include <cmath>

namespace folprom {

LeafSigns LeafSignsOf(SubtreeLod& lod, uint32_t set, double spacing) {
  LeafSigns signs;
  signs.spacing = spacing;
  signs.scale = static_cast<double>(lod.sets[set].scale);
  const Complex& complex = lod.complex;
  for (const auto& [other, half_edge] : complex.Spokes(set)) {
    if (!lod.sets[other].is_leaf) {
      ++signs.others;
      continue;
    }
    ++signs.leaves;
    const Vector3 d = Difference(lod.positions[other], lod.positions[set]);
    signs.leaf_distance = signs.leaf_distance + std::sqrt(Dot(d, d));
    signs.leaf_spacing = signs.leaf_spacing + static_cast<double>(lod.sets[other].spacing);
  }
  if (signs.leaves > 0) {
    signs.leaf_distance = signs.leaf_distance / signs.leaves;
    signs.leaf_spacing = signs.leaf_spacing / signs.leaves;
  }
  // Neighbours at the same place have no height either.
  signs.bend = spacing > 0 ? lod.HeightRange(set) / spacing : 0;
  return signs;
}

}  // namespace folprom
