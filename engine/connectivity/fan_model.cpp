#include "engine/connectivity/fan_model.h"

#include <algorithm>
#include <cmath>

#include "engine/entropy/bit_coder.h"
#include "engine/entropy/cell_model.h"

namespace folprom {
namespace {

/// Weights move by kStep * slope / sqrt(kSquares + recent squared slopes).
constexpr float kStep = 0.22F, kSquares = 0.3F, kFade = 0.9998F;
/// Of the decision whether a cut is the one: contexts, and sets of mixing weights.
constexpr uint32_t kMostRanks = 8, kPlaceBuckets = 8, kOddsBuckets = 16, kSets = 3;
constexpr double kLeastMass = 1e-9;
/// Log weight of what is no cut.
constexpr float kNever = -1e30F;

}  // namespace

constexpr std::array<FanModel::Table, FanFeatures::kRoles> FanModel::kTables{{
    {kShapeFirst, kKnots},
    {kShapeFirst + kKnots, 1},
    {kShapeSecond, kKnots},
    {kShapeSecond + kKnots, 1},
    {kLeanFirst, kKnots},
    {kAnglesFirst, kKnots},
    {kBendFirst, kKnots},
    {kLeanSecond, kKnots},
    {kBendSecond, kKnots},
    {kShapeNew, kKnots},
    {kShapeNew + kKnots, 1},
    {kAnglesPivotFirst, kKnots},
    {kAnglesPivotSecond, kKnots},
    {kBendPivot, kKnots},
    {kShapeNew, kKnots},
    {kShapeNew + kKnots, 1},
    {kAnglesPivotSecond, kKnots},
    {kAnglesPivotFirst, kKnots},
    {kBendPivot, kKnots},
    {kDegree, Features::kMostDegree + 1},
    {kAge, 2 * kAgeKnots},
    {kRest, kAgeKnots},
    {kAnglePivot, kKnots},
}};

FanModel::FanModel() : hit_({kMostRanks * kPlaceBuckets, kOddsBuckets * kSets}, kSets) {}

void FanModel::Visit(LearnedStateVisitor& visitor) {
  visitor.Values(weights_, 1.0F / 32);
  visitor.Values(squares_, 1.0F);
  hit_.Visit(visitor);
}

Lanes FanModel::Interpolate(Table table, Lanes knot, Terms* terms) const {
  // The last knot is reached from the one before it.
  const float most = static_cast<float>(table.knots - 1);
  const Lanes inside = LesserOf(GreaterOf(knot, AllLanes(0)), AllLanes(most));
  const LaneIntegers whole = WholeOf(LesserOf(inside, AllLanes(most - (most > 0 ? 0.5F : 0))));
  const LaneIntegers absent = knot < 0;
  const LaneIntegers begin = whole + static_cast<int32_t>(table.begin);
  terms->weight = absent ? begin * 0 + static_cast<int32_t>(kNowhere) : begin;
  terms->share = absent ? AllLanes(0) : inside - FloatsOf(whole);
  const NeighbouringLanes weights = LookUpTwo(weights_.data(), terms->weight);
  return weights.here + terms->share * (weights.next - weights.here);
}

Lanes FanModel::Sum(uint32_t first, uint32_t last, uint32_t group) {
  Lanes sum = AllLanes(0);
  for (uint32_t role = first; role <= last; ++role) {
    sum = sum + Interpolate(kTables[role], features_.knot(Features::Role(role), group),
                            &terms_[role][group]);
  }
  return sum;
}

void FanModel::Weigh(const Fan& fan) {
  const uint32_t n = fan.places;
  // Of faces and spokes inside the second child's part, over what they are in the first's.
  AroundFan face, spoke, first_spoke, begin, end, pivot;
  for (uint32_t g = 0; g < groups_; ++g) {
    const Lanes face_first = Sum(Features::kFaceFirstShape, Features::kFaceFirstTurned, g);
    face.Set(g, Sum(Features::kFaceSecondShape, Features::kFaceSecondTurned, g) - face_first);
    const Lanes in_first = Sum(Features::kSpokeFirstLean, Features::kSpokeFirstBend, g);
    first_spoke.Set(g, in_first);
    spoke.Set(g, Sum(Features::kSpokeSecondLean, Features::kSpokeSecondBend, g) - in_first);
    begin.Set(g, Sum(Features::kBeginShape, Features::kBeginBend, g));
    end.Set(g, Sum(Features::kEndShape, Features::kEndBend, g));
    pivot.Set(g, Sum(Features::kPivotDegree, Features::kPivotAngle, g));
  }
  if (fan.open) {
    const uint32_t out = n - 1;
    const float in_first = weights_[kOutside], in_second = weights_[kOutside + 1];
    first_spoke.SetPlace(out, in_first);
    spoke.SetPlace(out, in_second - in_first);
    pivot.SetPlace(out, weights_[kOutside + 2]);
  }
  // Neighbours that are pivots are no spokes of the first child, and those in between neither.
  AroundFan as_begin, as_end;
  float faces = 0, spokes = 0;
  for (uint32_t k = 0; k < n; ++k) {
    const float is_pivot = pivot.Of(k) - first_spoke.Of(k);
    as_end.SetPlace(k, end.Of(k) + is_pivot + faces + spokes);
    spokes += spoke.Of(k);
    as_begin.SetPlace(k, begin.Of(k) + is_pivot - faces - spokes);
    faces += face.Of(k);
  }
  for (uint32_t k = n; k < groups_ * kLanes; ++k) as_end.SetPlace(k, kNever);
  const float inverse = 1 / WeighCuts(fan, as_begin, as_end, faces + spokes);
  for (uint32_t i = 0; i < n; ++i) {
    most_left_[i] = AllLanes(0);
    for (uint32_t g = 0; g < groups_; ++g) {
      const Lanes part = LoadLanes(&left_[i][g * kLanes]) * inverse;
      StoreLanes(part, &left_[i][g * kLanes]);
      StoreLanes(part, &probability_[i][g * kLanes]);
      most_left_[i] = GreaterOf(most_left_[i], part);
    }
  }
}

float FanModel::WeighCuts(const Fan& fan, const AroundFan& as_begin, const AroundFan& as_end,
                          float wrapped) {
  const uint32_t n = fan.places, last = groups_ * kLanes;
  // By end - begin - 1 + n.
  for (uint32_t m = 0; m + 1 < n; ++m) {
    const float arc = weights_[kArcSecond + std::min(m, kMostArc)] +
                      weights_[kArcFirst + std::min(n - 2 - m, kMostArc)];
    arc_[m] = arc + wrapped;
    arc_[m + n] = arc;
  }
  arc_[n - 1] = kNever;
  for (uint32_t t = 2 * n - 1; t < n + last; ++t) arc_[t] = kNever;
  Lanes most = AllLanes(kNever);
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t g = 0; g < groups_; ++g) {
      const Lanes arc = LoadLanes(&arc_[n - 1 - i + g * kLanes]);
      const Lanes bend =
          Interpolate({kBendNew, kKnots}, features_.PairKnot(i, g), &bend_[i][g]);
      const Lanes score = as_begin.Of(i) + as_end.At(g) + arc + bend;
      StoreLanes(score, &left_[i][g * kLanes]);
      most = GreaterOf(most, score);
    }
  }
  const float highest = MostOf(most);
  Lanes sum = AllLanes(0);
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t g = 0; g < groups_; ++g) {
      const Lanes score = LoadLanes(&left_[i][g * kLanes]);
      const Lanes weight = FastExp2(GreaterOf(score - highest, AllLanes(-40)));
      const Lanes value = score < kNever / 2 ? AllLanes(0) : weight;
      StoreLanes(value, &left_[i][g * kLanes]);
      sum = sum + value;
    }
  }
  return SumOf(sum);
}

void FanModel::Add(uint32_t weight, float share, float error) {
  const float after = error * share;
  gradient_[weight + size_t{1}] += after;
  gradient_[weight] += error - after;
}

void FanModel::Spread(uint32_t first, uint32_t last, const AroundFan& error) {
  for (uint32_t role = first; role <= last; ++role) {
    for (uint32_t g = 0; g < groups_; ++g) {
      const Terms& terms = terms_[role][g];
      const Lanes now = error.At(g), after = now * terms.share, before = now - after;
      for (uint32_t lane = 0; lane < kLanes; ++lane) {
        const size_t weight = static_cast<size_t>(terms.weight[lane]);
        gradient_[weight + 1] += after[lane];
        gradient_[weight] += before[lane];
      }
    }
  }
}

void FanModel::LearnPairs(const Fan& fan, FanCut truth) {
  const uint32_t real = fan.places - (fan.open ? 1 : 0);
  for (uint32_t i = 0; i < real; ++i) {
    for (uint32_t j = i + 1; j < real; ++j) {
      const bool is_cut = (i == truth.begin && j == truth.end) ||
                          (j == truth.begin && i == truth.end);
      const float error = (is_cut ? 1.0F : 0.0F) - probability_[i][j] - probability_[j][i];
      const Terms& bend = bend_[i][j / kLanes];
      Add(static_cast<uint32_t>(bend.weight[j % kLanes]), bend.share[j % kLanes], error);
    }
  }
}

void FanModel::Learn(const Fan& fan, FanCut truth) {
  const uint32_t n = fan.places;
  LearnPairs(fan, truth);
  std::array<float, 2 * kMost + kLanes> arcs{};
  std::array<Lanes, kGroups> to{};
  AroundFan begins, ends;
  for (uint32_t i = 0; i < n; ++i) {
    Lanes from = AllLanes(0);
    for (uint32_t g = 0; g < groups_; ++g) {
      const Lanes part = LoadLanes(&probability_[i][g * kLanes]);
      from = from + part;
      to[g] = to[g] + part;
      float* arc = &arcs[n - 1 - i + g * kLanes];
      StoreLanes(LoadLanes(arc) + part, arc);
    }
    begins.SetPlace(i, (i == truth.begin ? 1.0F : 0.0F) - SumOf(from));
  }
  for (uint32_t g = 0; g < groups_; ++g) ends.Set(g, -to[g]);
  // By how much the face at place 0 belongs to the second child too rarely: of cuts that begin
  // there, and of those that end between it and their begin.
  const bool holds_first = truth.begin == 0 || (truth.begin > truth.end && truth.end > 0);
  float first_face = (holds_first ? 1.0F : 0.0F) - ((truth.begin == 0 ? 1.0F : 0.0F) - begins.Of(0));
  for (uint32_t m = 0; m + 1 < n; ++m) first_face -= arcs[m];
  first_face += to[0][0];
  ends.SetPlace(truth.end, 1 + ends.Of(truth.end));
  AroundFan in_second, in_first, second_spoke, first_spoke, pivots;
  float inside = first_face;
  for (uint32_t k = 0; k < n; ++k) {
    if (k > 0) inside += begins.Of(k) - ends.Of(k);
    in_second.SetPlace(k, inside);
    in_first.SetPlace(k, -inside);
    second_spoke.SetPlace(k, inside - begins.Of(k));
    first_spoke.SetPlace(k, -inside - ends.Of(k));
    pivots.SetPlace(k, begins.Of(k) + ends.Of(k));
  }
  Spread(Features::kFaceFirstShape, Features::kFaceFirstTurned, in_first);
  Spread(Features::kFaceSecondShape, Features::kFaceSecondTurned, in_second);
  Spread(Features::kSpokeFirstLean, Features::kSpokeFirstBend, first_spoke);
  Spread(Features::kSpokeSecondLean, Features::kSpokeSecondBend, second_spoke);
  Spread(Features::kBeginShape, Features::kBeginBend, begins);
  Spread(Features::kEndShape, Features::kEndBend, ends);
  Spread(Features::kPivotDegree, Features::kPivotAngle, pivots);
  if (fan.open) {
    gradient_[kOutside] += first_spoke.Of(n - 1);
    gradient_[kOutside + 1] += second_spoke.Of(n - 1);
    gradient_[kOutside + 2] += pivots.Of(n - 1);
  }
  const uint32_t arc = truth.end > truth.begin ? truth.end - truth.begin - 1
                                               : truth.end + n - truth.begin - 1;
  for (uint32_t m = 0; m + 1 < n; ++m) {
    const float error = (m == arc ? 1.0F : 0.0F) - arcs[m] - arcs[m + n];
    gradient_[kArcSecond + std::min(m, kMostArc)] += error;
    gradient_[kArcFirst + std::min(n - 2 - m, kMostArc)] += error;
  }
  gradient_[kNowhere] = gradient_[kNowhere + 1] = 0;
  Step();
}

void FanModel::Step() {
  for (uint32_t w = 0; w < kStored; w += kLanes) {
    const Lanes slope = LoadLanes(&gradient_[w]);
    const Lanes old_squares = LoadLanes(&squares_[w]);
    const LaneIntegers moves = slope != 0;
    if ((moves[0] | moves[1] | moves[2] | moves[3]) == 0) continue;
    StoreLanes(AllLanes(0), &gradient_[w]);
    const Lanes squares = moves ? kFade * old_squares + slope * slope : old_squares;
    StoreLanes(squares, &squares_[w]);
    const Lanes move = kStep * slope / SquareRoot(kSquares + squares);
    StoreLanes(LoadLanes(&weights_[w]) + move, &weights_[w]);
  }
}

FanCut FanModel::TakeLikeliest(uint32_t places, float* probability) {
  // What is no cut has 0, which every cut that is left exceeds.
  Lanes most = most_left_[0];
  for (uint32_t i = 1; i < places; ++i) most = GreaterOf(most, most_left_[i]);
  const float best = MostOf(most);
  FanCut cut;
  while (cut.begin + 1 < places && MostOf(most_left_[cut.begin]) < best) ++cut.begin;
  std::array<float, kMost>& left = left_[cut.begin];
  while (cut.end + 1 < places && left[cut.end] < best) ++cut.end;
  left[cut.end] = -1;
  most_left_[cut.begin] = AllLanes(0);
  for (uint32_t g = 0; g < groups_; ++g) {
    most_left_[cut.begin] = GreaterOf(most_left_[cut.begin], LoadLanes(&left[g * kLanes]));
  }
  *probability = best;
  return cut;
}

template <class Coder>
FanCut FanModel::Code(Coder& coder, const Fan& fan, std::span<const FanSpoke> spokes,
                      const Vector3& second, FanCut truth) {
  features_.Measure(fan, spokes, second);
  groups_ = features_.groups();
  Weigh(fan);
  const uint32_t n = fan.places, cuts = n * (n - 1);
  const uint32_t place_bucket = std::min(n - 3, kPlaceBuckets - 1);
  double mass = 1;
  float probability = 0;
  FanCut cut = TakeLikeliest(n, &probability);
  for (uint32_t rank = 0; rank + 1 < cuts; ++rank) {
    const double now = static_cast<double>(probability);
    mass = std::max(mass - now, kLeastMass);
    const double odds = 256 * detail::FastLog(std::max(now, kLeastMass) / mass);
    const int32_t prediction = static_cast<int32_t>(std::clamp(odds, -2047.0, 2047.0));
    const uint32_t bucket = static_cast<uint32_t>((prediction + 2047) / 256);
    const uint32_t early = std::min(rank, kSets - 1);
    const std::array<uint32_t, 2> contexts{
        std::min(rank, kMostRanks - 1) * kPlaceBuckets + place_bucket,
        early * kOddsBuckets + bucket};
    const bool hit = truth.begin == cut.begin && truth.end == cut.end;
    if (hit_.Code(coder, contexts, early, hit, {prediction})) break;
    cut = TakeLikeliest(n, &probability);
  }
  Learn(fan, cut);
  return cut;
}

template FanCut FanModel::Code<BitEncoder>(BitEncoder&, const Fan&, std::span<const FanSpoke>,
                                           const Vector3&, FanCut);
template FanCut FanModel::Code<BitDecoder>(BitDecoder&, const Fan&, std::span<const FanSpoke>,
                                           const Vector3&, FanCut);

}  // namespace folprom
