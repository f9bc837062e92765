#include "engine/codec/subtree_coder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/codec/leaf_signs.h"
#include "engine/codec/plane_coder.h"
#include "engine/entropy/bit_coder.h"
#include "engine/entropy/even_code.h"

namespace folprom {
namespace {

/// With light models a child that a round made is taken to have so much of its parent's spacing
/// until a round looks at it: it need not be measured to be left alone.
constexpr float kChildSpacing = 0.85F;

/// Coordinate `value` in [lo, hi], all equally likely.
template <class Coder>
int32_t CodeCoordinate(Coder& coder, int32_t lo, int32_t hi, int32_t value) {
  const uint32_t most = static_cast<uint32_t>(hi) - static_cast<uint32_t>(lo);
  const uint32_t offset = static_cast<uint32_t>(value) - static_cast<uint32_t>(lo);
  return lo +
         static_cast<int32_t>(CodeEvenly(coder, most, offset, "coded root lies outside its box"));
}

float Distance(const Int3& a, const Int3& b) {
  const Vector3 d = Difference(a, b);
  return static_cast<float>(std::sqrt(Dot(d, d)));
}

DueSettings DueSettingsOf(const CodecParameters& parameters, uint32_t vertices) {
  DueSettings settings;
  settings.always = parameters.settings.distortion_first * vertices;
  const Int3& extent = parameters.extent;
  settings.longest = std::max({extent.x, extent.y, extent.z});
  // K children of the root that are asked at once leave worse LODs, on horse by 8 % at 1 bpv.
  settings.ask_root = parameters.settings.offsets == Offsets::kLattice;
  return settings;
}

}  // namespace

SubtreeCoder::SubtreeCoder(const CodecParameters& parameters, const SubtreeShape& shape)
    : parameters_(parameters),
      shape_(shape),
      split_coder_(parameters.connectivity()),
      due_(DueSettingsOf(parameters, shape.vertices)),
      leaf_model_(parameters.has_light_models()),
      exceptions_(shape.mesh_faces) {
  if (parameters.settings.offsets == Offsets::kLattice) {
    lattice_coder_.emplace(shape.box_lo, shape.box_hi, parameters.lattice());
  } else {
    cylinder_children_.emplace(parameters.offsets(), parameters.children(), parameters.extent);
  }
  if (parameters.fits_lods()) fit_.emplace();
  if (!parameters.attributes.empty()) attributes_.emplace(parameters.attributes);
  if (const InitialStatistics* start = parameters.start()) {
    StatisticsLoader loader(*start);
    Visit(loader);
  }
}

void SubtreeCoder::Visit(LearnedStateVisitor& visitor) {
  if (lattice_coder_) lattice_coder_->Visit(visitor);
  split_coder_.Visit(visitor);
  due_.Visit(visitor);
  leaf_model_.Visit(visitor);
  border_.Visit(visitor);
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
  coder.SetMeter(&meters->refinement);
  if (lattice_coder_) {
    CodePlanes(coder, truth);
    CodePrecision(coder, truth);
    CodeLatticeRefinement(coder, truth);
  }
  const bool splits = layer_ < schedule.split_layers();
  if (splits) {
    CodeSplits(coder, truth, meters);
    coder.SetMeter(&meters->refinement);
    CodeFit(coder, truth);
  }
  if (cylinder_children_ && !(splits && parameters_.settings.split_first)) {
    coder.SetMeter(&meters->refinement);
    cylinder_children_->CodeRefinement(coder, schedule.RefineBound(layer_), &lod_, truth);
  }
  if (schedule.IsLastSplitLayer(layer_)) {
    coder.SetMeter(&meters->exceptions);
    CodeEndOfSplits(coder, truth);
  }
  if (layer_ + 1 == schedule.layers() && parameters_.has_rests()) {
    coder.SetMeter(&meters->rests);
    exact_positions_ = RestCoder(*parameters_.exact).Code(coder, lod_.positions, truth);
  }
  border_.EndLayer();
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
  lod_.complex.AddVertex();
  lod_.positions.push_back(root);
  SetRecord& record = lod_.sets.emplace_back();
  record.scale = Distance(shape_.box_lo, shape_.box_hi);
  record.is_leaf = shape_.vertices == 1;
  if (shape_.has_border) {
    record.border = 0;
    border_.AddRoot(root);
  }
  if (!record.is_leaf) open_.push_back(0);
  if (!lattice_coder_) return;
  lattice_coder_->AddExact();
  if (coder.Code(32768, Coder::kEncoding && truth->OnGrid())) {
    grid_.emplace(shape_.box_lo, shape_.box_hi);
  }
  if (attributes_) {
    const uint8_t* values = nullptr;
    if constexpr (Coder::kEncoding) values = truth->Attributes(0);
    attributes_->CodeRoot(coder, values);
  }
}

template <class Coder>
void SubtreeCoder::CodeSet(Coder& coder, uint32_t set, double spacing, SubtreeTruth* truth,
                           CostMeters* meters) {
  uint32_t count = 0;
  if constexpr (Coder::kEncoding) count = truth->ChildCount(set);
  GridHint hint;
  coder.SetMeter(&meters->split);
  count = CodeChildCount(coder, set, spacing, count, &hint);
  if (count == 1) {
    lod_.sets[set].is_leaf = true;
    lod_.sets[set].spacing = static_cast<float>(spacing);
    return;
  }
  if (lod_.size() + count - 1 > shape_.vertices) {
    throw Failure(ErrorKind::kCorrupt, "coded sets exceed the vertices of the subtree");
  }
  if (lattice_coder_) {
    CodeNewVertex(coder, set, hint, truth, meters);
  } else {
    CodeChildren(coder, set, count, truth, meters);
  }
}

template <class Coder>
uint32_t SubtreeCoder::CodeChildCount(Coder& coder, uint32_t set, double spacing, uint32_t count,
                                      GridHint* hint) {
  // Of the only set the table says how many vertices it holds.
  if (lod_.size() == 1) return std::min(shape_.vertices, parameters_.children());
  // Nothing is left to be split once all vertices are there.
  if (lod_.size() == shape_.vertices) return 1;
  if (grid_) {
    *hint = grid_->Expect(lod_, set);
    return grid_->CodeLeaf(coder, lod_, set, spacing, *hint, count == 1) ? 1 : 2;
  }
  if (!parameters_.has_light_models()) lod_.MeasureFaces(&star_);
  const LeafSigns signs = LeafSignsOf(lod_, star_, spacing);
  if (leaf_model_.Code(coder, signs, count == 1)) return 1;
  if (lattice_coder_) return 2;
  return cylinder_children_->CodeCount(coder, {spacing, signs.leaves, signs.others}, count);
}

template <class Coder>
void SubtreeCoder::CodeChildren(Coder& coder, uint32_t set, uint32_t count, SubtreeTruth* truth,
                                CostMeters* meters) {
  const std::vector<ChildGroup>& groups =
      cylinder_children_->CodePositions(coder, lod_, set, count, truth, &meters->offsets);
  struct Pending {
    uint32_t group, set;
  };
  std::vector<Pending> pending{{static_cast<uint32_t>(groups.size() - 1), set}};
  while (!pending.empty()) {
    const Pending now = pending.back();
    pending.pop_back();
    const ChildGroup& group = groups[now.group];
    if (group.first == kNone) {
      cylinder_children_->Finish(group.places[0], now.set, &lod_);
      if (!lod_.sets[now.set].is_leaf) open_.push_back(now.set);
      continue;
    }
    const ChildGroup &first = groups[group.first], &second = groups[group.second];
    if constexpr (Coder::kEncoding) truth->BeginBinarySplit(now.set, first.places, second.places);
    const uint32_t added =
        CodeBinarySplit(coder, now.set, first.position, second.position, nullptr, truth, meters);
    if constexpr (Coder::kEncoding) truth->EndBinarySplit(added);
    pending.push_back({group.second, added});
    pending.push_back({group.first, now.set});
  }
}

template <class Coder>
void SubtreeCoder::CodeNewVertex(Coder& coder, uint32_t set, const GridHint& hint,
                                 SubtreeTruth* truth, CostMeters* meters) {
  constexpr std::array<uint32_t, 2> kOrder{0, 1};
  const Int3 kept = lod_.positions[set];
  Int3 position;
  if constexpr (Coder::kEncoding) {
    position = truth->ChildRepresentative(set, 1);
    truth->BeginSplit(set, kOrder);
    truth->BeginBinarySplit(set, std::span(kOrder).first(1), std::span(kOrder).last(1));
  }
  if (hint.found) {
    coder.SetMeter(&meters->offsets.theta);
    position = grid_->CodePosition(coder, kept, hint, position);
    lattice_coder_->AddExact();
  } else {
    lod_.MeasureFaces(&star_);
    const auto code = [&](const auto& ring) {
      return lattice_coder_->CodeNew(coder, kept, ring, precision_.precision(), position,
                                     &meters->offsets.rho, &meters->offsets.z);
    };
    position = parameters_.has_light_models() ? code(lod_.LightRingAround(star_))
                                              : code(lod_.ShapeAround(star_));
  }
  const uint32_t added =
      CodeBinarySplit(coder, set, kept, position, hint.found ? &hint : nullptr, truth, meters);
  if constexpr (Coder::kEncoding) truth->EndBinarySplit(added);
  if (grid_) grid_->AddSplit(set, added, hint.found ? split_coder_.last_kind() : uint8_t{0});
  if (attributes_) {
    const uint8_t* values = nullptr;
    if constexpr (Coder::kEncoding) values = truth->Attributes(added);
    attributes_->CodeNew(coder, {lod_.complex, lod_.positions, added, set}, values,
                         meters->attributes.empty() ? nullptr : &meters->attributes);
  }
  const float before = lod_.sets[set].spacing;
  const bool is_told = parameters_.has_light_models() && before < SetRecord::kUnmeasured;
  const float known = is_told ? kChildSpacing * before : SetRecord::kUnmeasured;
  for (uint32_t child : {set, added}) {
    lod_.sets[child].scale = Distance(position, kept);
    lod_.sets[child].spacing = known;
    open_.push_back(child);
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
  const uint32_t added = split_coder_.Code(coder, lod_.complex, lod_.positions, set, known, oracle,
                                           &meters->connectivity, &meters->exceptions);
  CheckSize(lod_.complex, shape_.mesh_faces);
  lod_.positions[set] = first;
  lod_.positions.push_back(second);
  lod_.sets.push_back({});
  if (lod_.sets[set].border != kNone) {
    coder.SetMeter(&meters->seams);
    CodeBorder(coder, set, added, truth);
  }
  return added;
}

template <class Coder>
void SubtreeCoder::CodeBorder(Coder& coder, uint32_t first, uint32_t second,
                              const SubtreeTruth* truth) {
  BorderSplit split;
  split.first = lod_.positions[first];
  split.second = lod_.positions[second];
  split.degree = std::min(lod_.complex.Degree(first), BorderCoder::kMostDegree);
  split.gaps = GapsOf(lod_.complex, first, second);
  split.connected = split_coder_.last_connected();
  if constexpr (Coder::kEncoding) {
    split.first_touches = truth->FirstTouchesBorder();
    split.second_touches = truth->SecondTouchesBorder();
  }
  border_.CodeSplit(coder, split, &lod_.sets[first].border, &lod_.sets[second].border);
}

template <class Coder>
void SubtreeCoder::CodePrecision(Coder& coder, const SubtreeTruth* truth) {
  const uint32_t shift = parameters_.schedule.LatticeShift(layer_);
  if (shift == 0 || layer_ >= parameters_.schedule.split_layers() || open_.empty()) {
    precision_.Follow(shift);
    return;
  }
  LatticePrecision chosen;
  if constexpr (Coder::kEncoding) chosen = truth->Precision(lod_.complex, open_, shift);
  precision_.Code(coder, shift, chosen);
}

template <class Coder>
void SubtreeCoder::CodePlanes(Coder& coder, const SubtreeTruth* truth) {
  // Before, cells are too large for planes to tell much, and each byte counts.
  constexpr uint32_t kLeastVertices = 256, kLive = 1024, kLivePart = 8;
  if (has_told_planes_ || shape_.vertices < kLeastVertices ||
      lod_.size() < std::min(kLive, shape_.vertices / kLivePart)) {
    return;
  }
  has_told_planes_ = true;
  std::shared_ptr<const CoordinatePlanes> planes;
  if constexpr (Coder::kEncoding) planes = truth->Planes();
  lattice_coder_->UsePlanes(
      PlaneCoder(shape_.box_lo, shape_.box_hi).Code(coder, std::move(planes)));
}

template <class Coder>
void SubtreeCoder::CodeLatticeRefinement(Coder& coder, const SubtreeTruth* truth) {
  if (parameters_.schedule.BeginsStep(layer_)) refined_ = 0;
  const size_t parts = parameters_.schedule.parts_left(layer_) + size_t{1};
  for (const size_t end = refined_ + (lod_.size() - refined_) / parts; refined_ < end; ++refined_) {
    const auto vertex = static_cast<uint32_t>(refined_);
    if (!lattice_coder_->IsCoarser(vertex, precision_.precision())) continue;
    Int3 position;
    if constexpr (Coder::kEncoding) position = truth->VertexPosition(vertex);
    lod_.MeasureSpokes(vertex, &star_);
    lod_.MeasureFaces(&star_);
    lod_.positions[vertex] =
        lattice_coder_->Refine(coder, vertex, lod_.positions[vertex], lod_.PlaneAt(star_),
                               precision_.precision(), position);
  }
}

template <class Coder>
void SubtreeCoder::CodeFit(Coder& coder, const SubtreeTruth* truth) {
  if (!fit_ || open_.empty() || lod_.size() == fitted_size_) return;
  fitted_size_ = lod_.size();
  FitShares chosen{};
  if constexpr (Coder::kEncoding) chosen = truth->Fit(lod_, open_, fit_->shares());
  fit_->Code(coder, chosen);
}

template <class Coder>
void SubtreeCoder::CodeEndOfSplits(Coder& coder, const SubtreeTruth* truth) {
  if (lod_.size() != shape_.vertices) {
    throw Failure(ErrorKind::kCorrupt, "coded sets do not add up to the vertices of the subtree");
  }
  FaceCensus census;
  if constexpr (Coder::kEncoding) census = truth->CountFaces(lod_.complex);
  exceptions_.Code(coder, lod_.complex, Coder::kEncoding ? &census : nullptr);
}

std::vector<ExactPosition> SubtreeCoder::DrawnPositions(const Lattice& lattice,
                                                        double error_bound) const {
  if (!exact_positions_.empty() || !fit_ || open_.empty()) return exact_positions_;
  std::vector<ExactPosition> drawn;
  drawn.reserve(lod_.size());
  for (const Int3& position : lod_.positions) drawn.push_back(lattice.ToModel(position));
  const double longest = kShiftPart * error_bound / lattice.unit;
  for (const uint32_t set : open_) {
    const auto move = FitMoveOf(lod_, set);
    if (!move) continue;
    const Vector3 shift = fit_->ShiftOf(*move, longest);
    for (size_t i = 0; i < 3; ++i) drawn[set][i] = drawn[set][i] + lattice.unit * shift[i];
  }
  return drawn;
}

std::vector<uint32_t> SubtreeCoder::BorderVertices() const {
  std::vector<uint32_t> vertices(border_.set_count());
  for (uint32_t v = 0; v < lod_.sets.size(); ++v) {
    if (lod_.sets[v].border != kNone) vertices[lod_.sets[v].border] = v;
  }
  return vertices;
}

uint64_t SubtreeCoder::face_count() const { return exceptions_.FaceCount(lod_.complex); }

void SubtreeCoder::AppendFaces(std::vector<Face>* faces) const {
  exceptions_.AppendFaces(lod_.complex, faces);
}

#define FOLPROM_INSTANTIATE(Coder)                                                  \
  template void SubtreeCoder::CodeLayer<Coder>(Coder&, SubtreeTruth*, CostMeters*); \
  template void SubtreeCoder::CodeSet<Coder>(Coder&, uint32_t, double, SubtreeTruth*, CostMeters*);
FOLPROM_INSTANTIATE(BitEncoder)
FOLPROM_INSTANTIATE(BitDecoder)
#undef FOLPROM_INSTANTIATE

}  // namespace folprom
