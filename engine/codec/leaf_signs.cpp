#include "engine/codec/leaf_signs.h"

#include <cmath>

namespace folprom {

LeafSigns LeafSignsOf(const SubtreeLod& lod, const SetStar& star, double spacing) {
  LeafSigns signs;
  signs.spacing = spacing;
  signs.scale = static_cast<double>(lod.sets[star.set].scale);
  const auto spokes = lod.complex.Spokes(star.set);
  for (size_t n = 0; n < spokes.size(); ++n) {
    const SetRecord& other = lod.sets[spokes[n].target];
    if (!other.is_leaf) continue;
    ++signs.leaves;
    signs.leaf_distance = signs.leaf_distance + star.ring[n].z_length[1];
    signs.leaf_spacing = signs.leaf_spacing + static_cast<double>(other.spacing);
  }
  signs.others = static_cast<uint32_t>(spokes.size()) - signs.leaves;
  if (signs.leaves > 0) {
    signs.leaf_distance = signs.leaf_distance / signs.leaves;
    signs.leaf_spacing = signs.leaf_spacing / signs.leaves;
  }
  // Neighbours at the same place have no height either.
  const double length = std::sqrt(Dot(star.normal, star.normal));
  if (star.has_faces && spacing > 0 && length > 0) {
    signs.bend = HeightRange(star.ring, star.normal) / length / spacing;
  }
  return signs;
}

}  // namespace folprom
