#include "engine/codec/cylinder_children.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/codec/parameters.h"
#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

/// The order in which offsets are coded: theta, rho, z. Equal ones keep theirs.
std::vector<uint32_t> CodedOrder(const std::vector<OffsetIndex>& offsets) {
  std::vector<uint32_t> order(offsets.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    const OffsetIndex &l = offsets[a], &r = offsets[b];
    if (l.theta != r.theta) return l.theta < r.theta;
    return l.rho != r.rho ? l.rho < r.rho : l.z < r.z;
  });
  return order;
}

}  // namespace

CylinderChildren::CylinderChildren(const OffsetSettings& settings, uint32_t most_children,
                                   const Int3& extent)
    : offsets_(settings), most_children_(most_children), extent_(extent) {}

template <class Coder>
const std::vector<ChildGroup>& CylinderChildren::CodePositions(Coder& coder, SubtreeLod& lod,
                                                               uint32_t set, uint32_t count,
                                                               SubtreeTruth* truth,
                                                               OffsetMeters* meters) {
  const Int3 centre = lod.positions[set];
  const Neighbourhood at =
      MeasureNeighbourhood(centre, lod.Ring(set), static_cast<double>(lod.sets[set].scale));
  const OffsetSteps steps = offsets_.StepsFor(at, kLeafBound);
  if constexpr (Coder::kEncoding) {
    std::vector<OffsetIndex> found(count);
    for (uint32_t i = 0; i < count; ++i) {
      found[i] = offsets_.Quantise(at, steps, truth->ChildRepresentative(set, i));
    }
    const std::vector<uint32_t> order = CodedOrder(found);
    indices_.resize(count);
    for (uint32_t i = 0; i < count; ++i) indices_[i] = found[order[i]];
    truth->BeginSplit(set, order);
  }
  offsets_.CodeOffsets(coder, at, steps, count, &indices_, meters);
  child_cells_.resize(count);
  std::vector<Int3> positions(count);
  double reach = 0;
  for (uint32_t i = 0; i < count; ++i) {
    child_cells_[i] = offsets_.CellOf(at, steps, indices_[i]);
    positions[i] = child_cells_[i].Position(extent_);
    const Vector3 d = Difference(positions[i], centre);
    reach = std::max(reach, Dot(d, d));
  }
  child_scale_ = static_cast<float>(std::sqrt(reach));
  children_are_leaves_ = count < most_children_;
  groups_ = GroupChildren(positions);
  return groups_;
}

void CylinderChildren::Finish(uint32_t place, uint32_t set, SubtreeLod* lod) {
  SetRecord& record = lod->sets[set];
  record.scale = child_scale_;
  record.spacing = children_are_leaves_ ? child_scale_ : SetRecord::kUnmeasured;
  record.is_leaf = children_are_leaves_;
  if (cell_of_set_.size() < lod->size()) cell_of_set_.resize(lod->size(), kNone);
  uint32_t& cell = cell_of_set_[set];
  if (cell == kNone) {
    cell = static_cast<uint32_t>(cells_.size());
    cells_.push_back(child_cells_[place]);
    cell_vertex_.push_back(set);
  } else {
    cells_[cell] = child_cells_[place];
  }
}

template <class Coder>
void CylinderChildren::CodeRefinement(Coder& coder, double bound, SubtreeLod* lod,
                                      const SubtreeTruth* truth) {
  for (size_t i = 0; i < cells_.size(); ++i) {
    const uint32_t vertex = cell_vertex_[i];
    if (!lod->sets[vertex].is_leaf) continue;
    CylinderCell& cell = cells_[i];
    if (cell.AxisBound() <= bound) continue;
    CylinderPoint target;
    if constexpr (Coder::kEncoding) target = ToCylinder(cell.frame, truth->VertexPosition(vertex));
    do {
      const CylinderCell::Dimension dimension = cell.Longest();
      const bool upper = Coder::kEncoding && cell.LiesInUpper(dimension, target);
      cell.Halve(dimension, offsets_.CodeHalf(coder, cell, dimension, upper));
    } while (cell.AxisBound() > bound);
    lod->positions[vertex] = cell.Position(extent_);
  }
}

#define FOLPROM_INSTANTIATE(Coder)                                                   \
  template const std::vector<ChildGroup>& CylinderChildren::CodePositions<Coder>(    \
      Coder&, SubtreeLod&, uint32_t, uint32_t, SubtreeTruth*, OffsetMeters*);        \
  template void CylinderChildren::CodeRefinement<Coder>(Coder&, double, SubtreeLod*, \
                                                        const SubtreeTruth*);
FOLPROM_INSTANTIATE(BitEncoder)
FOLPROM_INSTANTIATE(BitDecoder)
#undef FOLPROM_INSTANTIATE

}  // namespace folprom
