// K children at once, at cylindrical or Cartesian offsets in the frame of their parent, and the
// refinement of their cells (sections 2.2 to 2.4).
#pragma once

#include <cstdint>
#include <vector>

#include "engine/codec/child_groups.h"
#include "engine/codec/subtree_lod.h"
#include "engine/codec/subtree_truth.h"
#include "engine/geometry/cylinder_cell.h"
#include "engine/geometry/offset_coder.h"
#include "engine/mesh/types.h"

namespace folprom {

class CylinderChildren {
 public:
  CylinderChildren(const OffsetSettings& settings, uint32_t most_children, const Int3& extent);

  /// Number of children of a set that is no single vertex.
  template <class Coder>
  uint32_t CodeCount(Coder& coder, const OffsetCoder::SetContext& context, uint32_t count) {
    return offsets_.CodeChildCount(coder, context, count);
  }
  /// Codes where the children of the set lie and begins its split; truth: encoder only. Returns
  /// the binary splits that are to follow, valid until the next call.
  template <class Coder>
  const std::vector<ChildGroup>& CodePositions(Coder& coder, SubtreeLod& lod, uint32_t set,
                                               uint32_t count, SubtreeTruth* truth,
                                               OffsetMeters* meters);
  /// The child at this place of the last split has become the set.
  void Finish(uint32_t place, uint32_t set, SubtreeLod* lod);
  /// Halves the cells of single vertices until their bound per axis is at most `bound`, lattice
  /// units. truth: encoder only.
  template <class Coder>
  void CodeRefinement(Coder& coder, double bound, SubtreeLod* lod, const SubtreeTruth* truth);

 private:
  OffsetCoder offsets_;
  uint32_t most_children_;
  Int3 extent_;
  std::vector<CylinderCell> cells_;
  std::vector<uint32_t> cell_vertex_;
  std::vector<uint32_t> cell_of_set_;  ///< index into cells_; kNone: the position is exact

  // Of the last split.
  std::vector<OffsetIndex> indices_;
  std::vector<CylinderCell> child_cells_;
  std::vector<ChildGroup> groups_;
  float child_scale_ = 0;
  bool children_are_leaves_ = false;
};

}  // namespace folprom
