#include "engine/codec/subtree_lod.h"

#include <algorithm>
#include <cmath>

#include "engine/connectivity/area_normal.h"

namespace folprom {

double SubtreeLod::Spacing(uint32_t set) const {
  const auto spokes = complex.Spokes(set);
  if (spokes.empty()) return static_cast<double>(sets[set].scale);
  double sum = 0;
  const Int3& centre = positions[set];
  for (const auto& spoke : spokes) {
    const Vector3 d = Difference(positions[spoke.target], centre);
    sum = sum + std::sqrt(Dot(d, d));
  }
  return sum / static_cast<double>(spokes.size());
}

void SubtreeLod::PrefetchRecord(uint32_t set) const {
  __builtin_prefetch(&sets[set]);
  __builtin_prefetch(&positions[set]);
  complex.PrefetchVertex(set);
}

void SubtreeLod::PrefetchRing(uint32_t set) const {
  complex.PrefetchFaces(set);
  for (const auto& spoke : complex.Spokes(set)) __builtin_prefetch(&positions[spoke.target]);
}

const std::vector<Int3>& SubtreeLod::Ring(uint32_t set) {
  ring_.clear();
  for (const auto& spoke : complex.Spokes(set)) ring_.push_back(positions[spoke.target]);
  return ring_;
}

RingShape SubtreeLod::ShapeAround(uint32_t set) {
  const Int3& centre = positions[set];
  FanSums fan;
  for (const uint32_t corner : complex.Corners(set)) {
    const auto [a, b] = complex.Opposite(corner);
    fan.AddFace(Difference(positions[a], centre), Difference(positions[b], centre));
  }
  return MeasureRing(centre, Ring(set), fan, static_cast<double>(sets[set].scale));
}

double SubtreeLod::HeightRange(uint32_t set) const {
  const Int3& centre = positions[set];
  const Vector3 normal = AreaNormal(complex, positions, set);
  double low = 0, high = 0;
  for (const auto& spoke : complex.Spokes(set)) {
    const double height = Dot(Difference(positions[spoke.target], centre), normal);
    low = std::min(low, height);
    high = std::max(high, height);
  }
  const double length = std::sqrt(Dot(normal, normal));
  return length > 0 ? (high - low) / length : 0;
}

}  // namespace folprom
