#include "engine/codec/subtree_coder.h"

#include <algorithm>
#include <cmath>

#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

/// With it the spacing that stands for a distortion is about the spacing of the sets that have it.
constexpr double kDistortionScale = 1.4;
/// Asking goes on while so many wait for each that is due: the surface is flat beside its features.
constexpr double kWaitingPerDue = 1.6;
/// It ends when so few are due.
constexpr double kLeastDue = 0.02;
/// Or when so many times distortion_first is live.
constexpr double kMostAsked = 3;

/// Coordinate `value` in [lo, hi], all equally likely.
template <class Coder>
int32_t CodeCoordinate(Coder& coder, int32_t lo, int32_t hi, int32_t value) {
  uint32_t span = static_cast<uint32_t>(hi) - static_cast<uint32_t>(lo), result = 0;
  uint32_t offset = static_cast<uint32_t>(value) - static_cast<uint32_t>(lo);
  for (int bit = static_cast<int>(std::bit_width(span)) - 1; bit >= 0; --bit) {
    result |= static_cast<uint32_t>(coder.Code(32768, (offset >> bit) & 1)) << bit;
  }
  if (result > span) throw Failure(ErrorKind::kCorrupt, "coded root lies outside its box");
  return lo + static_cast<int32_t>(result);
}

int32_t FloorMean(int64_t sum, int64_t count) {
  return static_cast<int32_t>(sum / count);  // coordinates are never negative
}

uint64_t SquaredDistance(const Int3& a, const Int3& b) {
  int64_t x = int64_t{a.x} - b.x, y = int64_t{a.y} - b.y, z = int64_t{a.z} - b.z;
  return static_cast<uint64_t>(x * x) + static_cast<uint64_t>(y * y) + static_cast<uint64_t>(z * z);
}

}  // namespace

CostMeters& CostMeters::operator+=(const CostMeters& other) {
  split += other.split;
  root += other.root;
  refinement += other.refinement;
  exceptions += other.exceptions;
  seams += other.seams;
  rests += other.rests;
  offsets.theta += other.offsets.theta;
  offsets.rho += other.offsets.rho;
  offsets.z += other.offsets.z;
  connectivity.connected += other.connectivity.connected;
  connectivity.pivots += other.connectivity.pivots;
  connectivity.sides += other.connectivity.sides;
  return *this;
}

SubtreeCoder::SubtreeCoder(const CodecParameters& parameters, const SubtreeShape& shape)
    : parameters_(parameters),
      shape_(shape),
      grid_leaf_({4 * 4 * 5, 16 * 64, 16 * 64}),
      split_coder_(parameters.connectivity()),
      finer_same_({2}),
      still_asking_({1}),
      border_both_({16}),
      border_side_({1}),
      exceptions_(shape.mesh_faces) {
  if (parameters.settings.offsets == Offsets::kLattice) {
    lattice_coder_.emplace(shape.box_lo, shape.box_hi, parameters.lattice());
  } else {
    offset_coder_.emplace(parameters.offsets());
  }
  if (const InitialStatistics* start = parameters.start()) {
    StatisticsLoader loader(*start);
    Visit(loader);
  }
}

void SubtreeCoder::Visit(LearnedStateVisitor& visitor) {
  if (lattice_coder_) lattice_coder_->Visit(visitor);
  split_coder_.Visit(visitor);
  due_model_.Visit(visitor);
  leaf_model_.Visit(visitor);
  border_both_.Visit(visitor);
  border_side_.Visit(visitor);
}

template <class Coder>
void SubtreeCoder::CodeLayer(Coder& coder, SubtreeTruth* truth, CostMeters* meters) {
  CostMeters unmetered;
  if (meters == nullptr) meters = &unmetered;
  const LayerSchedule& schedule = parameters_.schedule;
  if (layer_ == 0) {
    coder.SetMeter(&meters->root);
    CodeRoot(coder, truth);
  }
  bool lattice = parameters_.settings.offsets == Offsets::kLattice;
  if (lattice) {
    coder.SetMeter(&meters->refinement);
    CodePrecision(coder, truth);
    CodeLatticeRefinement(coder, truth, meters);
  }
  if (layer_ < schedule.split_layers()) {
    for (uint32_t round = 0; round < schedule.rounds(layer_); ++round) {
      CodeRound(coder, schedule.SplitSpacing(layer_, round), truth, meters);
    }
    if (!lattice && !parameters_.settings.split_first) {
      CodeRefinement(coder, schedule.RefineBound(layer_), truth, meters);
    }
    if (schedule.IsLastSplitLayer(layer_)) {
      if (positions_.size() != shape_.vertices) {
        throw Failure(ErrorKind::kCorrupt,
                      "coded sets do not add up to the vertices of the subtree");
      }
      coder.SetMeter(&meters->exceptions);
      FaceCensus census;
      if constexpr (Coder::kEncoding) census = truth->CountFaces(complex_);
      exceptions_.Code(coder, complex_, Coder::kEncoding ? &census : nullptr);
    }
  } else if (!lattice) {
    CodeRefinement(coder, schedule.RefineBound(layer_), truth, meters);
  }
  if (layer_ + 1 == schedule.layers() && parameters_.has_rests()) {
    coder.SetMeter(&meters->rests);
    exact_positions_ = RestCoder(*parameters_.exact).Code(coder, positions_, truth);
  }
  border_.layer_end.push_back(static_cast<uint32_t>(border_.events.size()));
  ++layer_;
}

template <class Coder>
void SubtreeCoder::CodeRoot(Coder& coder, SubtreeTruth* truth) {
  if (shape_.vertices == 0) throw Failure(ErrorKind::kCorrupt, "the subtree has no vertex");
  Int3 root;
  if constexpr (Coder::kEncoding) root = truth->RootRepresentative();
  root.x = CodeCoordinate(coder, shape_.box_lo.x, shape_.box_hi.x, root.x);
  root.y = CodeCoordinate(coder, shape_.box_lo.y, shape_.box_hi.y, root.y);
  root.z = CodeCoordinate(coder, shape_.box_lo.z, shape_.box_hi.z, root.z);
  complex_.AddVertex();
  positions_.push_back(root);
  SetRecord record;
  record.scale = static_cast<float>(
      std::sqrt(static_cast<double>(SquaredDistance(shape_.box_lo, shape_.box_hi))));
  record.state = shape_.vertices == 1 ? kLeaf : kUnknown;
  if (shape_.has_border) {
    record.border = border_sets_++;
    border_.root_position = root;
  }
  if (record.state != kLeaf) open_.push_back(0);
  sets_.push_back(record);
  if (!lattice_coder_) return;
  lattice_coder_->AddRoot();
  if (coder.Code(32768, Coder::kEncoding && truth->OnGrid())) {
    grid_.emplace();
    grid_->AddRoot();
  }
}

double SubtreeCoder::Spacing(uint32_t set) const {
  double sum = 0;
  uint32_t count = 0;
  const Int3& centre = positions_[set];
  for (uint32_t h = complex_.FirstHalfEdge(set); h != kNone; h = complex_.half_edge(h).next) {
    Vector3 d = Difference(positions_[complex_.half_edge(h).target], centre);
    sum = sum + std::sqrt(Dot(d, d));
    ++count;
  }
  return count == 0 ? static_cast<double>(sets_[set].scale) : sum / count;
}

LeafSigns SubtreeCoder::SignsOf(uint32_t set, double spacing) {
  LeafSigns signs;
  signs.spacing = spacing;
  signs.scale = static_cast<double>(sets_[set].scale);
  for (uint32_t h = complex_.FirstHalfEdge(set); h != kNone; h = complex_.half_edge(h).next) {
    const uint32_t other = complex_.half_edge(h).target;
    if (sets_[other].state != kLeaf) {
      ++signs.others;
      continue;
    }
    ++signs.leaves;
    const Vector3 d = Difference(positions_[other], positions_[set]);
    signs.leaf_distance = signs.leaf_distance + std::sqrt(Dot(d, d));
    signs.leaf_spacing = signs.leaf_spacing + static_cast<double>(sets_[other].spacing);
  }
  if (signs.leaves > 0) {
    signs.leaf_distance = signs.leaf_distance / signs.leaves;
    signs.leaf_spacing = signs.leaf_spacing / signs.leaves;
  }
  const RingShape ring = ShapeAround(set);
  signs.bend = ring.height_range / ring.spacing;
  return signs;
}

template <class Coder>
bool SubtreeCoder::CodeAsking(Coder& coder, double least_spacing, const SubtreeTruth* truth) {
  if (!(least_spacing > 0)) return false;
  // K children of the root that are asked at once leave worse LODs, on horse by 8 % at 1 bpv.
  if (offset_coder_ && positions_.size() == 1) return false;
  const double always = parameters_.settings.distortion_first * shape_.vertices;
  if (static_cast<double>(positions_.size()) < always) return true;
  if (!asking_ || static_cast<double>(positions_.size()) > kMostAsked * always) return false;
  bool pays = false;
  if constexpr (Coder::kEncoding) {
    uint32_t waiting = 0, due = 0;
    for (uint32_t set : open_) {
      if (IsDue(*truth, set, least_spacing)) {
        ++due;
      } else if (Spacing(set) >= least_spacing) {
        ++waiting;
      }
    }
    pays = waiting >= kWaitingPerDue * due && due >= kLeastDue * waiting;
  }
  return still_asking_.Code(coder, {0}, 0, pays);
}

bool SubtreeCoder::IsDue(const SubtreeTruth& truth, uint32_t set, double least_spacing) const {
  // Distortion grows with the fourth power of the spacing.
  const Int3& extent = parameters_.extent;
  const double longest = std::max({extent.x, extent.y, extent.z});
  const double fourth = kDistortionScale * truth.Distortion(set) * longest;
  return std::sqrt(std::sqrt(fourth)) >= least_spacing;
}

template <class Coder>
void SubtreeCoder::CodeRound(Coder& coder, double least_spacing, SubtreeTruth* truth,
                             CostMeters* meters) {
  ++round_;
  coder.SetMeter(&meters->split);
  asking_ = CodeAsking(coder, least_spacing, truth);
  if (grid_) OrderAlongSurface();
  // Children that are still large enough join the end of the list and the same round.
  size_t kept = 0;
  for (size_t i = 0; i < open_.size(); ++i) {
    uint32_t set = open_[i];
    SetRecord& record = sets_[set];
    if (record.state == kLeaf) continue;
    if (asking_) {
      double now = Spacing(set);
      if (positions_.size() == 1 || CodeDue(coder, set, now, least_spacing, truth, meters)) {
        CodeSet(coder, set, now, truth, meters);
      } else {
        open_[kept++] = set;
      }
      continue;
    }
    // Spacings fall as neighbours split, so one that was too small before is not measured again.
    double spacing = static_cast<double>(record.spacing);
    if (spacing >= least_spacing) {
      spacing = Spacing(set);
      record.spacing = static_cast<float>(spacing);
    }
    if (spacing < least_spacing) {
      open_[kept++] = set;
      continue;
    }
    CodeSet(coder, set, spacing, truth, meters);
  }
  open_.resize(kept);
}

DueSigns SubtreeCoder::DueSignsOf(uint32_t set, double spacing, double least_spacing) {
  DueSigns signs;
  signs.spacing = spacing / least_spacing;
  signs.scale = static_cast<double>(sets_[set].scale) / least_spacing;
  const RingShape ring = ShapeAround(set);
  const Int3& extent = parameters_.extent;
  const double longest = std::max({extent.x, extent.y, extent.z});
  const double fourth = ring.spacing * ring.spacing * ring.height_range * longest;
  signs.distortion = std::sqrt(std::sqrt(fourth)) / least_spacing;
  signs.asked = sets_[set].asked + 1 == round_;
  for (uint32_t h = complex_.FirstHalfEdge(set); h != kNone; h = complex_.half_edge(h).next) {
    const SetRecord& other = sets_[complex_.half_edge(h).target];
    if (other.state == kLeaf) continue;
    if (other.asked == round_) ++signs.waiting;
    if (other.asked == 0) ++signs.split;
  }
  return signs;
}

void SubtreeCoder::OrderAlongSurface() {
  std::vector<uint8_t> state(positions_.size(), 0);  // 1: open, 2: open and reached, 3: reached
  for (uint32_t set : open_) state[set] = 1;
  std::vector<uint32_t> reached, ordered;
  for (uint32_t start : open_) {
    if (state[start] != 1) continue;
    state[start] = 2;
    reached.assign(1, start);
    for (size_t i = 0; i < reached.size(); ++i) {
      const uint32_t set = reached[i];
      if (state[set] == 2) ordered.push_back(set);
      for (uint32_t h = complex_.FirstHalfEdge(set); h != kNone; h = complex_.half_edge(h).next) {
        const uint32_t other = complex_.half_edge(h).target;
        if (state[other] >= 2) continue;
        state[other] = state[other] == 1 ? 2 : 3;
        reached.push_back(other);
      }
    }
  }
  open_ = std::move(ordered);
}

template <class Coder>
bool SubtreeCoder::CodeDue(Coder& coder, uint32_t set, double spacing, double least_spacing,
                           SubtreeTruth* truth, CostMeters* meters) {
  bool due = false;
  if constexpr (Coder::kEncoding) {
    due = IsDue(*truth, set, least_spacing);
  }
  coder.SetMeter(&meters->split);
  due = due_model_.Code(coder, DueSignsOf(set, spacing, least_spacing), due);
  sets_[set].asked = due ? 0 : round_;
  return due;
}

template <class Coder>
void SubtreeCoder::CodeSet(Coder& coder, uint32_t set, double spacing, SubtreeTruth* truth,
                           CostMeters* meters) {
  coder.SetMeter(&meters->split);
  uint32_t count = 0;
  if constexpr (Coder::kEncoding) count = truth->ChildCount(set);
  if (set == 0 && positions_.size() == 1) {
    // The only set: the table says how many vertices it holds.
    count = std::min(shape_.vertices, parameters_.children());
  } else {
    const LeafSigns signs = SignsOf(set, spacing);
    // Nothing is left to be split once all vertices are there.
    bool leaf = positions_.size() == shape_.vertices;
    if (!leaf && grid_) {
      leaf = CodeGridLeaf(coder, set, spacing, count == 1);
    } else if (!leaf) {
      leaf = leaf_model_.Code(coder, signs, count == 1);
    }
    if (leaf) {
      count = 1;
    } else if (offset_coder_) {
      count = offset_coder_->CodeChildCount(coder, {spacing, signs.leaves, signs.others}, count);
    } else {
      count = 2;
    }
  }
  if (count == 1) {
    sets_[set].state = kLeaf;
    sets_[set].spacing = static_cast<float>(spacing);
    return;
  }
  if (positions_.size() + count - 1 > shape_.vertices) {
    throw Failure(ErrorKind::kCorrupt, "coded sets exceed the vertices of the subtree");
  }
  if (parameters_.settings.offsets == Offsets::kLattice) {
    CodeNewVertex(coder, set, truth, meters);
  } else {
    CodeChildren(coder, set, count, truth, meters);
  }
}

template <class Coder>
bool SubtreeCoder::CodeGridLeaf(Coder& coder, uint32_t set, double spacing, bool leaf) {
  const GridPeers peers = grid_->PeersOf(
      complex_, positions_, set, [&](uint32_t other) { return sets_[other].state == kLeaf; });
  const GridHint hint = grid_->Expect(complex_, positions_, set);
  const uint32_t expects = hint.found ? 1 + hint.support : 0;
  const uint32_t known = std::min(peers.leaves, 3u) * 4 + std::min(peers.split, 3u);
  const double octaves = 8 * 1.44269504 * detail::FastLog(std::max(spacing, 1.0));
  const auto fine = static_cast<uint32_t>(std::min(octaves, 63.0));
  const double ratio =
      32 + 12 * 1.44269504 *
               detail::FastLog(std::max(spacing, 0.1) /
                               std::max(static_cast<double>(sets_[set].scale), 0.1));
  const auto made = static_cast<uint32_t>(std::clamp(ratio, 0.0, 63.0));
  return grid_leaf_.Code(coder, {known * 5 + expects, known * 64 + fine, known * 64 + made}, 0,
                         leaf);
}

template <class Coder>
void SubtreeCoder::CodeChildren(Coder& coder, uint32_t set, uint32_t count, SubtreeTruth* truth,
                                CostMeters* meters) {
  CollectRing(set);
  Neighbourhood at =
      MeasureNeighbourhood(positions_[set], ring_, static_cast<double>(sets_[set].scale));
  OffsetSteps steps = offset_coder_->StepsFor(at, kLeafBound);
  if constexpr (Coder::kEncoding) {
    std::vector<OffsetIndex> found(count);
    order_.resize(count);
    for (uint32_t i = 0; i < count; ++i) {
      found[i] = offset_coder_->Quantise(at, steps, truth->ChildRepresentative(set, i));
      order_[i] = i;
    }
    std::stable_sort(order_.begin(), order_.end(), [&](uint32_t a, uint32_t b) {
      const OffsetIndex &l = found[a], &r = found[b];
      if (l.theta != r.theta) return l.theta < r.theta;
      return l.rho != r.rho ? l.rho < r.rho : l.z < r.z;
    });
    offsets_.resize(count);
    for (uint32_t i = 0; i < count; ++i) offsets_[i] = found[order_[i]];
    truth->BeginSplit(set, order_);
  }
  offset_coder_->CodeOffsets(coder, at, steps, count, &offsets_, &meters->offsets);
  child_cells_.resize(count);
  child_positions_.resize(count);
  double reach = 0;
  for (uint32_t i = 0; i < count; ++i) {
    child_cells_[i] = offset_coder_->CellOf(at, steps, offsets_[i]);
    child_positions_[i] = child_cells_[i].Position(parameters_.extent);
    Vector3 d = Difference(child_positions_[i], positions_[set]);
    reach = std::max(reach, Dot(d, d));
  }
  child_scale_ = static_cast<float>(std::sqrt(reach));
  children_are_leaves_ = count < parameters_.children();
  GroupChildren(count);
  CodeBinarySplits(coder, set, truth, meters);
}

void SubtreeCoder::CollectRing(uint32_t set) {
  ring_.clear();
  for (uint32_t h = complex_.FirstHalfEdge(set); h != kNone; h = complex_.half_edge(h).next) {
    ring_.push_back(positions_[complex_.half_edge(h).target]);
  }
}

RingShape SubtreeCoder::ShapeAround(uint32_t set) {
  const Int3& centre = positions_[set];
  CollectRing(set);
  FanSums fan;
  for (uint32_t c = complex_.FirstCorner(set); c != kNone; c = complex_.corner(c).next) {
    fan.AddFace(Difference(positions_[complex_.corner(NextCorner(c)).vertex], centre),
                Difference(positions_[complex_.corner(PreviousCorner(c)).vertex], centre));
  }
  return MeasureRing(centre, ring_, fan, static_cast<double>(sets_[set].scale));
}

template <class Coder>
void SubtreeCoder::CodeNewVertex(Coder& coder, uint32_t set, SubtreeTruth* truth,
                                 CostMeters* meters) {
  constexpr std::array<uint32_t, 2> kOrder{0, 1};
  Int3 position;
  if constexpr (Coder::kEncoding) {
    position = truth->ChildRepresentative(set, 1);
    truth->BeginSplit(set, kOrder);
  }
  GridHint hint;
  if (grid_) hint = grid_->Expect(complex_, positions_, set);
  if (hint.found) {
    coder.SetMeter(&meters->offsets.theta);
    position = lattice_coder_->CodeOnGrid(coder, positions_[set], hint, position);
  } else {
    position = lattice_coder_->CodeNew(coder, positions_[set], ShapeAround(set), precision_,
                                       position, &meters->offsets.rho, &meters->offsets.z);
  }
  if constexpr (Coder::kEncoding) {
    truth->BeginBinarySplit(set, std::span(kOrder).first(1), std::span(kOrder).last(1));
  }
  const Int3 kept = positions_[set];
  Vector3 d = Difference(position, kept);
  uint32_t added =
      CodeBinarySplit(coder, set, kept, position, hint.found ? &hint : nullptr, truth, meters);
  if (grid_) {
    grid_->AddSplit(set, added);
    if (hint.found) grid_->SetKind(split_coder_.last_kind());
  }
  if constexpr (Coder::kEncoding) truth->EndBinarySplit(added);
  for (uint32_t child : {set, added}) {
    sets_[child].scale = static_cast<float>(std::sqrt(Dot(d, d)));
    sets_[child].spacing = kUnmeasured;
    sets_[child].asked = 0;
    open_.push_back(child);
  }
}

template <class Coder>
void SubtreeCoder::CodePrecision(Coder& coder, SubtreeTruth* truth) {
  const uint32_t shift = parameters_.schedule.LatticeShift(layer_);
  const bool growing = shift > 0 && layer_ < parameters_.schedule.split_layers() && !open_.empty();
  if (growing) {
    LatticePrecision chosen;
    if constexpr (Coder::kEncoding) chosen = truth->Precision(complex_, open_, shift);
    finer_[0] = CodeFiner(coder, 0, shift - chosen.tangential);
    const uint32_t left = shift - std::min(finer_[0], shift);
    finer_[1] = CodeFiner(coder, 1, left - chosen.normal);
  }
  precision_.tangential = shift - std::min(finer_[0], shift);
  precision_.normal = precision_.tangential - std::min(finer_[1], precision_.tangential);
}

template <class Coder>
uint32_t SubtreeCoder::CodeFiner(Coder& coder, uint32_t which, uint32_t finer) {
  const uint32_t before = finer_[which];
  if (finer_same_.Code(coder, {which}, 0, finer == before)) return before;
  uint32_t coded = 0;
  for (uint32_t bit = 0; bit < 5; ++bit) {
    coded |= static_cast<uint32_t>(coder.Code(32768, (finer >> bit & 1) != 0)) << bit;
  }
  return coded;
}

template <class Coder>
void SubtreeCoder::CodeLatticeRefinement(Coder& coder, SubtreeTruth* truth, CostMeters* meters) {
  coder.SetMeter(&meters->refinement);
  for (uint32_t vertex = 0; vertex < positions_.size(); ++vertex) {
    if (!lattice_coder_->IsCoarser(vertex, precision_)) continue;
    Int3 position;
    if constexpr (Coder::kEncoding) position = truth->VertexPosition(vertex);
    positions_[vertex] = lattice_coder_->Refine(coder, vertex, positions_[vertex],
                                                ShapeAround(vertex), precision_, position);
  }
}

void SubtreeCoder::GroupChildren(uint32_t count) {
  groups_.clear();
  std::vector<uint32_t> live(count);
  std::vector<std::array<int64_t, 3>> sums(count);
  for (uint32_t i = 0; i < count; ++i) {
    const Int3& p = child_positions_[i];
    groups_.push_back({p, kNone, kNone, {i}});
    sums[i] = {p.x, p.y, p.z};
    live[i] = i;
  }
  while (live.size() > 1) {
    size_t left = 0, right = 1;
    uint64_t nearest = ~uint64_t{0};
    for (size_t i = 0; i < live.size(); ++i) {
      for (size_t j = i + 1; j < live.size(); ++j) {
        uint64_t distance = SquaredDistance(groups_[live[i]].position, groups_[live[j]].position);
        if (distance < nearest) {
          nearest = distance;
          left = i;
          right = j;
        }
      }
    }
    Group merged;
    merged.first = live[left];
    merged.second = live[right];
    merged.places = groups_[merged.first].places;
    const auto& more = groups_[merged.second].places;
    merged.places.insert(merged.places.end(), more.begin(), more.end());
    std::array<int64_t, 3> sum;
    for (size_t i = 0; i < 3; ++i) sum[i] = sums[merged.first][i] + sums[merged.second][i];
    int64_t members = static_cast<int64_t>(merged.places.size());
    merged.position = {FloorMean(sum[0], members), FloorMean(sum[1], members),
                       FloorMean(sum[2], members)};
    live[left] = static_cast<uint32_t>(groups_.size());
    live.erase(live.begin() + static_cast<std::ptrdiff_t>(right));
    groups_.push_back(std::move(merged));
    sums.push_back(sum);
  }
}

template <class Coder>
void SubtreeCoder::CodeBinarySplits(Coder& coder, uint32_t set, SubtreeTruth* truth,
                                    CostMeters* meters) {
  struct Pending {
    uint32_t group, set;
  };
  std::vector<Pending> pending{{static_cast<uint32_t>(groups_.size() - 1), set}};
  while (!pending.empty()) {
    Pending now = pending.back();
    pending.pop_back();
    const Group& group = groups_[now.group];
    if (group.first == kNone) {
      FinishChild(group.places[0], now.set);
      continue;
    }
    const Group &first = groups_[group.first], &second = groups_[group.second];
    if constexpr (Coder::kEncoding) truth->BeginBinarySplit(now.set, first.places, second.places);
    uint32_t added =
        CodeBinarySplit(coder, now.set, first.position, second.position, nullptr, truth, meters);
    if constexpr (Coder::kEncoding) truth->EndBinarySplit(added);
    pending.push_back({group.second, added});
    pending.push_back({group.first, now.set});
  }
}

template <class Coder>
uint32_t SubtreeCoder::CodeBinarySplit(Coder& coder, uint32_t set, const Int3& first,
                                       const Int3& second, const GridHint* hint,
                                       SubtreeTruth* truth, CostMeters* meters) {
  SplitCoder::Known known;
  known.grid = hint;
  known.first = first;
  known.second = second;
  SplitOracle* oracle = nullptr;
  if constexpr (Coder::kEncoding) oracle = truth->oracle();
  uint32_t added = split_coder_.Code(coder, complex_, positions_, set, known, oracle,
                                     &meters->connectivity, &meters->exceptions);
  CheckSize(complex_, shape_.mesh_faces);
  positions_[set] = first;
  positions_.push_back(second);
  sets_.push_back({});
  if (sets_[set].border == kNone) return added;

  coder.SetMeter(&meters->seams);
  bool first_border = false, second_border = false;
  if constexpr (Coder::kEncoding) {
    first_border = truth->FirstTouchesBorder();
    second_border = truth->SecondTouchesBorder();
  }
  uint32_t degree = 0;
  for (uint32_t h = complex_.FirstHalfEdge(set); h != kNone && degree < 15;
       h = complex_.half_edge(h).next) {
    ++degree;
  }
  bool both = border_both_.Code(coder, {degree}, 0, first_border && second_border);
  if (!both) {
    second_border = border_side_.Code(coder, {0}, 0, second_border);
    first_border = !second_border;
  }
  BorderEvent event;
  event.border = sets_[set].border;
  event.connected = split_coder_.last_connected() ? 1 : 0;
  if (both) {
    event.both = 1;
    event.first_position = first;
    event.second_position = second;
    sets_[added].border = border_sets_++;
  } else {
    event.first_position = event.second_position = first_border ? first : second;
    if (second_border) std::swap(sets_[added].border, sets_[set].border);
  }
  border_.events.push_back(event);
  return added;
}

void SubtreeCoder::FinishChild(uint32_t place, uint32_t set) {
  SetRecord& record = sets_[set];
  record.scale = child_scale_;
  record.spacing = children_are_leaves_ ? child_scale_ : kUnmeasured;
  record.state = children_are_leaves_ ? kLeaf : kUnknown;
  if (record.cell == kNone) {
    record.cell = static_cast<uint32_t>(cells_.size());
    cells_.push_back(child_cells_[place]);
    cell_vertex_.push_back(set);
  } else {
    cells_[record.cell] = child_cells_[place];
  }
  if (record.state != kLeaf) open_.push_back(set);
}

template <class Coder>
void SubtreeCoder::CodeRefinement(Coder& coder, double bound, SubtreeTruth* truth,
                                  CostMeters* meters) {
  coder.SetMeter(&meters->refinement);
  for (uint32_t i = 0; i < cells_.size(); ++i) {
    uint32_t vertex = cell_vertex_[i];
    if (sets_[vertex].state != kLeaf) continue;
    CylinderCell& cell = cells_[i];
    if (cell.AxisBound() <= bound) continue;
    CylinderPoint target;
    if constexpr (Coder::kEncoding) target = ToCylinder(cell.frame, truth->VertexPosition(vertex));
    do {
      CylinderCell::Dimension dimension = cell.Longest();
      bool upper = Coder::kEncoding && cell.LiesInUpper(dimension, target);
      cell.Halve(dimension, offset_coder_->CodeHalf(coder, cell, dimension, upper));
    } while (cell.AxisBound() > bound);
    positions_[vertex] = cell.Position(parameters_.extent);
  }
}

std::vector<uint32_t> SubtreeCoder::BorderVertices() const {
  std::vector<uint32_t> vertices(border_sets_);
  for (uint32_t v = 0; v < sets_.size(); ++v) {
    if (sets_[v].border != kNone) vertices[sets_[v].border] = v;
  }
  return vertices;
}

uint64_t SubtreeCoder::face_count() const { return exceptions_.FaceCount(complex_); }

void SubtreeCoder::AppendFaces(std::vector<Face>* faces) const {
  exceptions_.AppendFaces(complex_, faces);
}

template void SubtreeCoder::CodeLayer<BitEncoder>(BitEncoder&, SubtreeTruth*, CostMeters*);
template void SubtreeCoder::CodeLayer<BitDecoder>(BitDecoder&, SubtreeTruth*, CostMeters*);

}  // namespace folprom
