#include "engine/codec/subtree_lod.h"

#include <cmath>

namespace folprom {

double SubtreeLod::Spacing(uint32_t set) const {
  double sum = 0;
  uint32_t count = 0;
  const Int3& centre = positions[set];
  for (uint32_t h = complex.FirstHalfEdge(set); h != kNone; h = complex.half_edge(h).next) {
    Vector3 d = Difference(positions[complex.half_edge(h).target], centre);
    sum = sum + std::sqrt(Dot(d, d));
    ++count;
  }
  return count == 0 ? static_cast<double>(sets[set].scale) : sum / count;
}

const std::vector<Int3>& SubtreeLod::Ring(uint32_t set) {
  ring_.clear();
  for (uint32_t h = complex.FirstHalfEdge(set); h != kNone; h = complex.half_edge(h).next) {
    ring_.push_back(positions[complex.half_edge(h).target]);
  }
  return ring_;
}

RingShape SubtreeLod::ShapeAround(uint32_t set) {
  const Int3& centre = positions[set];
  FanSums fan;
  for (uint32_t c = complex.FirstCorner(set); c != kNone; c = complex.corner(c).next) {
    fan.AddFace(Difference(positions[complex.corner(NextCorner(c)).vertex], centre),
                Difference(positions[complex.corner(PreviousCorner(c)).vertex], centre));
  }
  return MeasureRing(centre, Ring(set), fan, static_cast<double>(sets[set].scale));
}

}  // namespace folprom
