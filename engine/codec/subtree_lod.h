// The current LOD of a subtree: surface, positions, and what is known of each vertex set.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/connectivity/complex.h"
#include "engine/geometry/light_ring.h"
#include "engine/geometry/ring_shape.h"
#include "engine/mesh/types.h"

namespace folprom {

/// A vertex set, named by the LOD vertex that stands for it.
struct SetRecord {
  static constexpr float kUnmeasured = 3e38f;
  float scale = 0;  ///< spacing to assume without neighbours, lattice units
  /// When last measured, never far below the present one; of a leaf, when it was found to be one;
  /// with light models, of a child not measured yet, a part of its parent's.
  float spacing = kUnmeasured;
  uint32_t border = kNone;  ///< number of the border set
  uint32_t asked = 0;       ///< the last step in which it was not due, 0: none since its split
  bool is_leaf = false;     ///< a single vertex
};

/// What surrounds a set, measured once for all that goes by it.
struct SetStar {
  uint32_t set = kNone;
  std::span<const RingSpoke> ring;  ///< in the order of its spokes
  bool has_faces = false;           ///< those of this set; false: the next two are of another
  std::span<const FanFace> faces;   ///< in the order of its corners
  Vector3 normal{0, 0, 0};          ///< sum over the faces, each twice as long as its face is large
  // What the lists above are part of; never smaller than it was.
  std::vector<RingSpoke> all_spokes;
  std::vector<FanFace> all_faces;
};

/// The three lists go by the number of the LOD vertex.
class SubtreeLod {
 public:
  Complex complex;
  std::vector<Int3> positions;
  std::vector<SetRecord> sets;

  size_t size() const { return positions.size(); }
  /// Asks for the memory of a set that will be looked at: of its record, once that is there of
  /// its star, and then of its ring. Each reads what the one before has asked for.
  void PrefetchRecord(uint32_t set) const;
  void PrefetchStar(uint32_t set) const { complex.PrefetchStar(set); }
  void PrefetchRing(uint32_t set) const;
  /// Mean distance to the neighbours, without any the set's scale; lattice units.
  double Spacing(uint32_t set) const;
  /// Positions of the neighbours, valid until the next call.
  const std::vector<Int3>& Ring(uint32_t set);
  /// The spokes of a set's star; returns its spacing.
  double MeasureSpokes(uint32_t set, SetStar* star) const;
  /// And the faces, once.
  void MeasureFaces(SetStar* star) const;
  RingPlane PlaneAt(const SetStar& star) const {
    return MeasurePlane(star.ring, star.normal, static_cast<double>(sets[star.set].scale));
  }
  RingShape ShapeAround(const SetStar& star) const;
  /// It looks at the star's spokes.
  LightRing LightRingAround(const SetStar& star) const;

 private:
  std::vector<Int3> ring_;
};

}  // namespace folprom
