// Sets that come from regular grids: are they single vertices, and where do new vertices lie.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/codec/subtree_lod.h"
#include "engine/entropy/cell_model.h"
#include "engine/entropy/mixed_model.h"
#include "engine/entropy/online_regression.h"
#include "engine/geometry/grid_pattern.h"
#include "engine/mesh/types.h"

namespace folprom {

class GridCoder {
 public:
  /// Coordinates lie in [lo, hi].
  GridCoder(const Int3& lo, const Int3& hi);

  /// What the splits around a set say of its next one.
  GridHint Expect(const SubtreeLod& lod, uint32_t set) const {
    return pattern_.Expect(lod.complex, lod.positions, set);
  }
  /// Is the set a single vertex. leaf: encoder only.
  template <class Coder>
  bool CodeLeaf(Coder& coder, const SubtreeLod& lod, uint32_t set, double spacing,
                const GridHint& hint, bool leaf);
  /// Where a hint was found: the position of the vertex that a split of `old` adds, at once with
  /// all bits, since most of them follow from what is known. truth: encoder only.
  template <class Coder>
  Int3 CodePosition(Coder& coder, const Int3& old, const GridHint& hint, const Int3& truth);
  /// kind: how the split parted the ring, 0 where no hint was found.
  void AddSplit(uint32_t parent, uint32_t added, uint8_t kind) {
    pattern_.AddSplit(parent, added);
    pattern_.SetKind(kind);
  }

 private:
  std::array<int32_t, 3> lo_, hi_;
  GridPattern pattern_;
  /// Peers that are leaves, that were split since, and what the grid says of a next split.
  MixedModel<3> leaf_;
  // By number of splits that tell of the vertex.
  static constexpr uint32_t kSupports = GridHint::kMostSupport + 1;
  CellModel<3, 2> position_;
  std::vector<OnlineRegression<3>> fit_;
  std::vector<OnlineRegression<2>> follow_;  ///< what misses on earlier axes say of an axis
  ScaleTable scale_;
};

}  // namespace folprom
