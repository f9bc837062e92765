#include "engine/connectivity/split_coder.h"

#include <algorithm>
#include <cmath>

#include "engine/connectivity/lean.h"
#include "engine/entropy/bit_coder.h"
#include "engine/entropy/fixed_math.h"

namespace folprom {
namespace {

constexpr uint32_t kRegularityBuckets = 16;

uint32_t RegularityBucket(uint32_t regularity) {
  int bucket = HalfOctave(regularity) - 17;  // an equilateral triangle gives 27 * 16
  return static_cast<uint32_t>(std::clamp(bucket, 0, static_cast<int>(kRegularityBuckets) - 1));
}

uint32_t DegreeBucket(size_t degree) {
  if (degree <= 7) return static_cast<uint32_t>(degree);
  return degree <= 9 ? 8 : (degree <= 14 ? 9 : 10);
}
constexpr uint32_t kDegreeBuckets = 11;

/// The paper's R (section 3.2), squared, in 1/16. + - * / and square roots, so exact to
/// repeat.
uint32_t Regularity(double a2, double b2, double c2) {
  double a = std::sqrt(a2), b = std::sqrt(b2), c = std::sqrt(c2);
  double s = (a + b + c) / 2;
  double product = (s - a) * (s - b) * (s - c);
  constexpr double kLargest = 2147483647;
  if (!(product > 0)) return static_cast<uint32_t>(kLargest);
  double value = 16 * (s * s * s / product);
  return static_cast<uint32_t>(value < kLargest ? value : kLargest);
}

uint32_t AtMost(uint32_t value, uint32_t most) { return value < most ? value : most; }

}  // namespace

SplitCoder::SplitCoder(ConnectivitySettings settings)
    : settings_(settings),
      stays_fan_({2 * kDegreeBuckets}),
      connected_({kDegreeBuckets * 4, 16 * 4}, 1),
      pivot_({8 * 4 * 2 * kDegreeBuckets, kRegularityBuckets * 4 * 9, 4 * kLeanBuckets * 8 * 4}, 8),
      side_({kLeanBuckets * 4 * 2, 3 * 3 * kLeanBuckets * 2, kDegreeBuckets * kLeanBuckets}, 4),
      face_both_({16, 4}, 1),
      face_turn_({3}, 1),
      face_side_({kLeanBuckets, 4}, 1),
      new_face_({9 * 3, 6 * 3}, 1),
      orientation_({15}, 1) {}

void SplitCoder::Visit(LearnedStateVisitor& visitor) {
  stays_fan_.Visit(visitor);
  if (!fan_model_) fan_model_ = std::make_unique<FanModel>();
  fan_model_->Visit(visitor);
  connected_.Visit(visitor);
  pivot_.Visit(visitor);
  side_.Visit(visitor);
  face_both_.Visit(visitor);
  face_side_.Visit(visitor);
  new_face_.Visit(visitor);
  orientation_.Visit(visitor);
}

void SplitCoder::Gather(const Complex& complex, uint32_t vertex) {
  if (slot_of_vertex_.size() < complex.vertex_count()) {
    slot_of_vertex_.resize(complex.vertex_count() + complex.vertex_count() / 2, kNone);
  }
  const auto spokes = complex.Spokes(vertex);
  const auto corners = complex.Corners(vertex);
  star_.vertex = vertex;
  star_.neighbours.resize(spokes.size());
  star_.faces.resize(corners.size());
  for (uint32_t n = 0; n < spokes.size(); ++n) {
    const auto [target, half_edge] = spokes[n];
    complex.PrefetchEdge(half_edge);
    complex.PrefetchVertex(target);
    slot_of_vertex_[target] = n;
    star_.neighbours[n] = {.vertex = target, .half_edge = half_edge};
  }
  for (uint32_t f = 0; f < corners.size(); ++f) {
    const auto [next, previous] = complex.Opposite(corners[f]);
    star_.faces[f] = {.corner = corners[f],
                      .end = {slot_of_vertex_[next], slot_of_vertex_[previous]}};
  }
  for (const auto& neighbour : star_.neighbours) slot_of_vertex_[neighbour.vertex] = kNone;
}

void SplitCoder::LinkFaces() {
  for (uint32_t f = 0; f < star_.faces.size(); ++f) {
    SplitStar::StarFace& face = star_.faces[f];
    for (uint32_t i = 0; i < 2; ++i) {
      if (face.end[i] == kNone) continue;
      SplitStar::Neighbour& neighbour = star_.neighbours[face.end[i]];
      face.next_link[i] = neighbour.first_face;
      neighbour.first_face = 2 * f + i;
      ++neighbour.face_count;
    }
  }
}

void SplitCoder::Measure(const std::vector<Int3>& positions, const Known& known) {
  double between = SquaredDistance(known.first, known.second);
  children_distance_ = std::sqrt(between);
  mean_distance_ = 0;
  const Int3& parent = positions[star_.vertex];
  for (auto& neighbour : star_.neighbours) {
    const Int3& position = positions[neighbour.vertex];
    double to_first = SquaredDistance(position, known.first);
    double to_second = SquaredDistance(position, known.second);
    neighbour.regularity = Regularity(to_first, to_second, between);
    neighbour.lean = LeanOf(to_first, to_second, between);
    mean_distance_ += std::sqrt(SquaredDistance(position, parent));
  }
  if (!star_.neighbours.empty()) mean_distance_ /= static_cast<double>(star_.neighbours.size());
}

template <class Coder>
bool SplitCoder::CodeFan(Coder& coder, const Complex& complex, const std::vector<Int3>& positions,
                         const Known& known, SplitOracle* oracle, SplitMeters* meters) {
  fan_ = FindFan(star_);
  if (fan_.places == 0) return false;
  coder.SetMeter(&meters->connected);
  FanCut truth;
  if constexpr (Coder::kEncoding) truth = TrueCut(fan_, star_, *oracle);
  const uint32_t context = DegreeBucket(star_.neighbours.size()) * 2 + (fan_.open ? 1 : 0);
  if (!stays_fan_.Code(coder, {context}, 0, truth.begin != truth.end)) return false;
  auto relative = [&](const Int3& p) { return Difference(p, known.first); };
  const uint32_t vertices = complex.vertex_count();
  for (uint32_t place = 0; place < fan_.places; ++place) {
    if (fan_.IsOutside(place)) continue;
    const uint32_t vertex = star_.neighbours[fan_.neighbour[place]].vertex;
    complex.PrefetchStar(vertex);
    spokes_[place] = {relative(positions[vertex]), complex.Degree(vertex),
                      static_cast<double>(vertex) / vertices, vertex > star_.vertex,
                      vertices - last_split_[vertex]};
  }
  coder.SetMeter(&meters->pivots);
  if (known.grid != nullptr && !grid_cuts_) grid_cuts_ = std::make_unique<GridCuts>();
  const bool on_grid = known.grid != nullptr && grid_cuts_->Find(fan_, star_, *known.grid);
  cut_ = on_grid ? grid_cuts_->Code(coder, fan_, truth) : FanCut{};
  if (cut_.begin == cut_.end) {
    cut_ = CodeCut(coder, relative(known.second), truth);
  }
  if (on_grid) grid_kind_ = grid_cuts_->Learn(fan_, *known.grid, cut_);
  star_.connected = true;
  PartFan(fan_, cut_, &star_);
  return true;
}

template <class Coder>
FanCut SplitCoder::CodeCut(Coder& coder, const Vector3& second, FanCut truth) {
  if (settings_.light) {
    if (!light_fan_model_) light_fan_model_ = std::make_unique<LightFanModel>();
    return light_fan_model_->Code(coder, fan_, spokes_, second, truth);
  }
  if (!fan_model_) fan_model_ = std::make_unique<FanModel>();
  return fan_model_->Code(coder, fan_, spokes_, second, truth);
}

void SplitCoder::SortPivotCandidates() {
  order_.resize(star_.neighbours.size());
  for (uint32_t i = 0; i < order_.size(); ++i) order_[i] = i;
  bool by_regularity = settings_.pivot_order;
  std::sort(order_.begin(), order_.end(), [&](uint32_t a, uint32_t b) {
    const auto& left = star_.neighbours[a];
    const auto& right = star_.neighbours[b];
    if (by_regularity && left.regularity != right.regularity) {
      return left.regularity < right.regularity;
    }
    return left.vertex < right.vertex;
  });
}

template <class Coder>
void SplitCoder::CodePivots(Coder& coder, SplitOracle* oracle, SplitMeters* meters) {
  coder.SetMeter(&meters->pivots);
  pivots_ = 0;
  uint32_t degree = DegreeBucket(order_.size());
  for (uint32_t rank = 0; rank < order_.size(); ++rank) {
    auto& neighbour = star_.neighbours[order_[rank]];
    uint32_t beside_pivot = 0, beside_other = 0;
    ForEachLink(order_[rank], [&](uint32_t, uint32_t other) {
      if (other == kNone) return;
      uint32_t place = star_.neighbours[other].side;
      if (place == kBoth) ++beside_pivot;
      if (place == kFirst) ++beside_other;  // kFirst marks "looked at, no pivot" during this pass
    });
    uint32_t found = AtMost(pivots_, 3), joined = star_.connected ? 1 : 0;
    uint32_t regularity = RegularityBucket(neighbour.regularity);
    uint32_t context0 = ((AtMost(rank, 7) * 4 + found) * 2 + joined) * kDegreeBuckets + degree;
    uint32_t context1 =
        (regularity * 4 + found) * 9 + AtMost(beside_pivot, 2) * 3 + AtMost(beside_other, 2);
    uint32_t context2 =
        ((AtMost(neighbour.face_count, 3) * kLeanBuckets + LeanBucket(neighbour.lean)) * 8 +
         regularity / 2) *
            4 +
        found;
    bool pivot = false;
    if constexpr (Coder::kEncoding) {
      pivot = oracle->NeighbourSide(neighbour.half_edge, neighbour.vertex) == kBoth;
    }
    pivot = pivot_.Code(coder, {context0, context1, context2}, joined * 4 + found, pivot);
    neighbour.side = pivot ? kBoth : kFirst;
    if (pivot) ++pivots_;
    if (meters->tally) {
      const uint32_t size = AtMost(static_cast<uint32_t>(order_.size()), 15);
      meters->tally->pivots.Add(pivot ? 1 : 0, size * 16 + AtMost(rank, 15));
    }
  }
  for (auto& neighbour : star_.neighbours) {
    if (neighbour.side != kBoth) neighbour.side = kUndecided;
  }
}

void SplitCoder::SpreadSide(uint32_t start, Side side) {
  // A face of two neighbours that are no pivots lies on one side, and so do both of them.
  star_.neighbours[start].side = side;
  stack_.assign(1, start);
  while (!stack_.empty()) {
    uint32_t current = stack_.back();
    stack_.pop_back();
    ForEachLink(current, [&](uint32_t, uint32_t other) {
      if (other == kNone || star_.neighbours[other].side != kUndecided) return;
      star_.neighbours[other].side = side;
      stack_.push_back(other);
    });
  }
}

template <class Coder>
void SplitCoder::CodeSides(Coder& coder, SplitOracle* oracle, SplitMeters* meters) {
  coder.SetMeter(&meters->sides);
  auto size_of_lean = [&](uint32_t i) {
    int32_t lean = star_.neighbours[i].lean;
    return lean < 0 ? -lean : lean;
  };
  std::sort(order_.begin(), order_.end(), [&](uint32_t a, uint32_t b) {
    int32_t left = size_of_lean(a), right = size_of_lean(b);
    if (left != right) return left > right;
    return star_.neighbours[a].vertex < star_.neighbours[b].vertex;
  });
  uint32_t decided = 0, degree = DegreeBucket(order_.size()), joined = star_.connected ? 1 : 0;
  Side last = kUndecided;
  for (uint32_t index : order_) {
    auto& neighbour = star_.neighbours[index];
    if (neighbour.side != kUndecided) continue;
    Side nearer = settings_.nearer_child && neighbour.lean < 0 ? kFirst : kSecond;
    uint32_t lean = LeanBucket(neighbour.lean);
    uint32_t relation = last == kUndecided ? 0 : (last == nearer ? 1 : 2);
    uint32_t context0 = (lean * 4 + AtMost(pivots_, 3)) * 2 + joined;
    uint32_t context1 = ((relation * 3 + AtMost(decided, 2)) * kLeanBuckets + lean) * 2 +
                        (neighbour.face_count > 1 ? 1 : 0);
    uint32_t context2 = degree * kLeanBuckets + lean;
    bool farther = false;
    if constexpr (Coder::kEncoding) {
      farther = oracle->NeighbourSide(neighbour.half_edge, neighbour.vertex) != nearer;
    }
    farther = side_.Code(coder, {context0, context1, context2}, AtMost(decided, 3), farther);
    if (meters->tally) meters->tally->sides.Add(farther ? 1 : 0);
    last = farther ? (nearer == kFirst ? kSecond : kFirst) : nearer;
    SpreadSide(index, last);
    ++decided;
  }
}

template <class Coder>
uint32_t SplitCoder::Code(Coder& coder, Complex& complex, const std::vector<Int3>& positions,
                          uint32_t vertex, const Known& known, SplitOracle* oracle,
                          SplitMeters* meters, uint64_t* exception_meter) {
  Gather(complex, vertex);
  grid_kind_ = 0;
  owns_child_edge_ = known.code_connected;
  while (last_split_.size() < complex.vertex_count()) {
    last_split_.push_back(static_cast<uint32_t>(last_split_.size()));
  }
  const bool may_stay_fan = settings_.fan_cuts && (known.code_connected || known.connected);
  if (may_stay_fan && CodeFan(coder, complex, positions, known, oracle, meters)) {
    last_split_[vertex] = complex.vertex_count();
    star_.second = complex.AddVertex();
    star_.child_edge = kNone;
    ApplySides(complex);
    AddFanFaces(complex);
    if constexpr (Coder::kEncoding) oracle->Commit(star_);
    return star_.second;
  }
  last_split_[vertex] = complex.vertex_count();
  LinkFaces();
  Measure(positions, known);
  star_.second = complex.AddVertex();
  star_.child_edge = kNone;
  coder.SetMeter(&meters->connected);
  star_.connected = known.connected;
  if (known.code_connected) {
    double ratio = mean_distance_ > 0 ? 64 * children_distance_ / mean_distance_ : 0;
    uint32_t bucket = static_cast<uint32_t>(
        std::clamp(HalfOctave(static_cast<uint64_t>(std::min(ratio, 1e6))), 0, 15));
    uint32_t degree = DegreeBucket(star_.neighbours.size());
    uint32_t faces = AtMost(static_cast<uint32_t>(star_.faces.size()), 3);
    bool truth = false;
    if constexpr (Coder::kEncoding) truth = oracle->connected();
    star_.connected = connected_.Code(coder, {degree * 4 + faces, bucket * 4 + faces}, 0, truth);
  }
  SortPivotCandidates();
  CodePivots(coder, oracle, meters);
  CodeSides(coder, oracle, meters);
  coder.SetMeter(exception_meter);
  CodeFaces(coder, complex, positions, known, oracle);
  ApplySides(complex);
  CodeNewFaces(coder, oracle, complex);
  if constexpr (Coder::kEncoding) oracle->Commit(star_);
  return star_.second;
}

template uint32_t SplitCoder::Code<BitEncoder>(BitEncoder&, Complex&, const std::vector<Int3>&,
                                               uint32_t, const Known&, SplitOracle*, SplitMeters*,
                                               uint64_t*);
template uint32_t SplitCoder::Code<BitDecoder>(BitDecoder&, Complex&, const std::vector<Int3>&,
                                               uint32_t, const Known&, SplitOracle*, SplitMeters*,
                                               uint64_t*);

}  // namespace folprom
