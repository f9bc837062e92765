#include "engine/connectivity/fan_model.h"

#include <algorithm>
#include <cmath>

#include "engine/entropy/bit_coder.h"
#include "engine/entropy/cell_model.h"

namespace folprom {
namespace {

/// Knots of a quantity; values between them are interpolated.
constexpr uint32_t kKnots = 8, kAgeKnots = 12;
constexpr uint32_t kMostDegree = 15, kMostArc = 11;

// Where the weights of each quantity begin. The shapes of triangles have one more, for those that
// are turned over.
constexpr uint32_t kShapeFirst = 0, kShapeSecond = kShapeFirst + kKnots + 1,
                   kShapeNew = kShapeSecond + kKnots + 1, kAnglesFirst = kShapeNew + kKnots + 1,
                   kAnglesPivotFirst = kAnglesFirst + kKnots,
                   kAnglesPivotSecond = kAnglesPivotFirst + kKnots,
                   kAnglePivot = kAnglesPivotSecond + kKnots, kBendFirst = kAnglePivot + kKnots,
                   kBendSecond = kBendFirst + kKnots, kBendPivot = kBendSecond + kKnots,
                   kBendNew = kBendPivot + kKnots, kLeanFirst = kBendNew + kKnots,
                   kLeanSecond = kLeanFirst + kKnots, kDegree = kLeanSecond + kKnots,
                   kAge = kDegree + kMostDegree + 1, kRest = kAge + 2 * kAgeKnots,
                   kArcFirst = kRest + kAgeKnots, kArcSecond = kArcFirst + kMostArc + 1,
                   kOutside = kArcSecond + kMostArc + 1, kWeights = kOutside + 3;
/// One more so that every term has a weight after its own; a multiple of a vector's width.
constexpr size_t kStored = (kWeights + 1 + 7) / 8 * 8;

/// Weights move by kStep * slope / sqrt(kSquares + recent squared slopes).
constexpr float kStep = 0.22F, kSquares = 0.3F, kFade = 0.9998F;
/// Of the decision whether a cut is the one: contexts, and sets of mixing weights.
constexpr uint32_t kMostRanks = 8, kPlaceBuckets = 8, kOddsBuckets = 16, kSets = 3;
constexpr double kLeastMass = 1e-9;

Vector3 Minus(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// -1 .. 1, steep around 0.
double Squeeze(double x) { return x / (1 + std::fabs(x)); }

double Cotangent(double dot, double cross) { return dot / std::max(cross, 1e-9); }

}  // namespace

FanModel::FanModel()
    : weights_(kStored),
      gradient_(kStored),
      squares_(kStored),
      hit_({kMostRanks * kPlaceBuckets, kOddsBuckets * kSets}, kSets) {}

void FanModel::Visit(LearnedStateVisitor& visitor) {
  visitor.Values(weights_, 1.0F / 32);
  visitor.Values(squares_, 1.0F);
  hit_.Visit(visitor);
}

FanModel::Triangle FanModel::TriangleOf(const Vector3& a, const Vector3& b) {
  Triangle triangle;
  triangle.normal = Cross(a, b);
  triangle.length = std::sqrt(Dot(triangle.normal, triangle.normal));
  const Vector3 side = Minus(b, a);
  const double squares = Dot(a, a) + Dot(b, b) + Dot(side, side);
  triangle.shape = squares > 0 ? 3.4641016 * triangle.length / squares : 0;
  return triangle;
}

void FanModel::Add(Terms* terms, uint32_t table, double knot, uint32_t knots) {
  const double most = static_cast<double>(knots - 1);
  if (!(knot > 0)) knot = 0;
  if (knot > most) knot = most;
  const uint32_t whole = std::min(static_cast<uint32_t>(knot), knots - 2);
  const double share = knot - static_cast<double>(whole);
  const uint32_t weight = table + whole;
  terms->term[terms->count++] = {static_cast<uint16_t>(weight), static_cast<float>(share)};
  const double low = static_cast<double>(weights_[weight]);
  terms->sum += low + share * (static_cast<double>(weights_[weight + 1]) - low);
}

void FanModel::AddShape(Terms* terms, uint32_t table, const Triangle& triangle, double sign) {
  Add(terms, table, triangle.shape * (kKnots - 1), kKnots);
  if (sign * Dot(triangle.normal, normal_) < 0) {
    const uint32_t turned = table + kKnots;
    terms->term[terms->count++] = {static_cast<uint16_t>(turned), 0};
    terms->sum += static_cast<double>(weights_[turned]);
  }
}

void FanModel::AddBend(Terms* terms, uint32_t table, const Triangle& a, const Triangle& b,
                       double sign) {
  const double lengths = a.length * b.length;
  const double cosine = lengths > 0 ? sign * Dot(a.normal, b.normal) / lengths : -1;
  const double bend = std::sqrt(std::sqrt(std::max(0.0, (1 - cosine) / 2)));
  Add(terms, table, bend * (kKnots - 1), kKnots);
}

void FanModel::AddAngles(Terms* terms, uint32_t table, double cotangents) {
  Add(terms, table, (Squeeze(cotangents) + 1) * ((kKnots - 1) / 2.0), kKnots);
}

void FanModel::Measure(const Fan& fan, std::span<const Spoke> spokes, const Vector3& second) {
  spacing2_ = std::max(Dot(second, second), 0.25);
  normal_ = {0, 0, 0};
  const uint32_t real = fan.places - (fan.open ? 1 : 0);
  for (uint32_t k = 0; k < real; ++k) {
    first_to_[k] = spokes[k].position;
    second_to_[k] = Minus(first_to_[k], second);
    of_both_[k] = TriangleOf(second, first_to_[k]);
    const double length = of_both_[k].length;
    at_first_[k] = Cotangent(Dot(second, first_to_[k]), length);
    at_second_[k] = Cotangent(-Dot(second, second_to_[k]), length);
    at_pivot_[k] = Cotangent(Dot(first_to_[k], second_to_[k]), length);
  }
  for (uint32_t k = 0; k < fan.places; ++k) {
    if (fan.face[k] == kNone) continue;
    const uint32_t next = fan.Next(k);
    const Vector3 side = Minus(first_to_[next], first_to_[k]);
    of_first_[k] = TriangleOf(first_to_[k], first_to_[next]);
    of_second_[k] = TriangleOf(second_to_[k], second_to_[next]);
    for (size_t i = 0; i < 3; ++i) normal_[i] = normal_[i] + of_first_[k].normal[i];
    first_at_[k] = Cotangent(-Dot(side, first_to_[k]), of_first_[k].length);
    first_at_next_[k] = Cotangent(Dot(side, first_to_[next]), of_first_[k].length);
    second_at_[k] = Cotangent(-Dot(side, second_to_[k]), of_second_[k].length);
    second_at_next_[k] = Cotangent(Dot(side, second_to_[next]), of_second_[k].length);
  }
}

void FanModel::CollectFaces(const Fan& fan) {
  for (uint32_t k = 0; k < fan.places; ++k) {
    face_first_[k].count = face_second_[k].count = 0;
    face_first_[k].sum = face_second_[k].sum = 0;
    if (fan.face[k] == kNone) continue;
    AddShape(&face_first_[k], kShapeFirst, of_first_[k], 1);
    AddShape(&face_second_[k], kShapeSecond, of_second_[k], 1);
  }
}

void FanModel::CollectSpokes(const Fan& fan) {
  for (uint32_t k = 0; k < fan.places; ++k) {
    Terms &first = spoke_first_[k], &second = spoke_second_[k];
    first.count = second.count = 0;
    first.sum = second.sum = 0;
    if (fan.IsOutside(k)) {
      Add(&first, kOutside, 0, 2);
      Add(&second, kOutside, 1, 2);
      continue;
    }
    const double nearer = Dot(first_to_[k], first_to_[k]) - Dot(second_to_[k], second_to_[k]);
    const double lean = (Squeeze(nearer / spacing2_) + 1) * ((kKnots - 1) / 2.0);
    Add(&first, kLeanFirst, lean, kKnots);
    Add(&second, kLeanSecond, lean, kKnots);
    const uint32_t before = fan.Previous(k);
    if (fan.face[k] == kNone || fan.face[before] == kNone) continue;
    AddAngles(&first, kAnglesFirst, first_at_[before] + first_at_next_[k]);
    AddBend(&first, kBendFirst, of_first_[before], of_first_[k], 1);
    AddBend(&second, kBendSecond, of_second_[before], of_second_[k], 1);
  }
}

void FanModel::CollectPivots(const Fan& fan, std::span<const Spoke> spokes) {
  for (uint32_t k = 0; k < fan.places; ++k) {
    Terms &begin = begin_[k], &end = end_[k], &pivot = pivot_[k];
    begin.count = end.count = pivot.count = 0;
    begin.sum = end.sum = pivot.sum = 0;
    if (fan.IsOutside(k)) {
      Add(&pivot, kOutside + 1, 1, 2);
      continue;
    }
    const Spoke& spoke = spokes[k];
    Add(&pivot, kDegree, static_cast<double>(spoke.degree), kMostDegree + 1);
    Add(&pivot, kAge + (spoke.younger ? kAgeKnots : 0), spoke.age * (kAgeKnots - 1), kAgeKnots);
    const double octaves = 1.44269504 * detail::FastLog(1 + static_cast<double>(spoke.splits_past));
    Add(&pivot, kRest, octaves * (kAgeKnots - 1) / 19, kAgeKnots);
    AddAngles(&pivot, kAnglePivot, at_pivot_[k]);
    // The new triangle (first, second, neighbour) has the orientation of the fan at the end of the
    // second child's part, the opposite at its beginning.
    AddShape(&begin, kShapeNew, of_both_[k], -1);
    AddShape(&end, kShapeNew, of_both_[k], 1);
    const uint32_t before = fan.Previous(k);
    if (fan.face[before] != kNone) {
      AddAngles(&begin, kAnglesPivotFirst, at_second_[k] + first_at_[before]);
      AddAngles(&end, kAnglesPivotSecond, at_first_[k] + second_at_[before]);
      AddBend(&end, kBendPivot, of_both_[k], of_second_[before], 1);
    }
    if (fan.face[k] != kNone) {
      AddAngles(&begin, kAnglesPivotSecond, at_first_[k] + second_at_next_[k]);
      AddAngles(&end, kAnglesPivotFirst, at_second_[k] + first_at_next_[k]);
      AddBend(&begin, kBendPivot, of_both_[k], of_second_[k], -1);
    }
  }
}

void FanModel::WeighPairs(const Fan& fan) {
  const uint32_t n = fan.places, real = n - (fan.open ? 1 : 0);
  for (uint32_t i = 0; i < real; ++i) {
    for (uint32_t j = i + 1; j < real; ++j) {
      Terms bend;
      AddBend(&bend, kBendNew, of_both_[i], of_both_[j], -1);
      bend_[i][j] = bend_[j][i] = bend.term[0];
      left_[i][j] = left_[j][i] = bend.sum;
    }
    if (fan.open) left_[i][real] = left_[real][i] = 0;
  }
  for (uint32_t m = 0; m + 1 < n; ++m) {
    arc_[m] = static_cast<double>(weights_[kArcSecond + std::min(m, kMostArc)]) +
              static_cast<double>(weights_[kArcFirst + std::min(n - 2 - m, kMostArc)]);
  }
}

void FanModel::Weigh(const Fan& fan) {
  const uint32_t n = fan.places;
  double most = -1e300;
  for (uint32_t i = 0; i < n; ++i) {
    // Neighbours that are pivots are no spokes of the first child, and those in between neither.
    double between = begin_[i].sum + pivot_[i].sum - spoke_first_[i].sum;
    uint32_t last = i;
    for (uint32_t m = 0; m + 1 < n; ++m) {
      const uint32_t j = fan.Next(last);
      between += face_second_[last].sum - face_first_[last].sum;
      double& score = left_[i][j];
      score += between + arc_[m] + end_[j].sum + pivot_[j].sum - spoke_first_[j].sum;
      most = std::max(most, score);
      between += spoke_second_[j].sum - spoke_first_[j].sum;
      last = j;
    }
  }
  double sum = 0;
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t j = 0; j < n; ++j) {
      if (i == j) continue;
      double& value = left_[i][j];
      value = detail::FastExp2(std::max(value - most, -40.0));
      sum += value;
    }
  }
  const double inverse = 1 / sum;
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t j = 0; j < n; ++j) {
      probability_[i][j] = i == j ? 0 : left_[i][j] * inverse;
      left_[i][j] = probability_[i][j];
    }
  }
}

void FanModel::Spread(const Terms& terms, double error) {
  for (uint32_t t = 0; t < terms.count; ++t) {
    const Term& term = terms.term[t];
    const float after = static_cast<float>(error) * term.share;
    gradient_[term.weight + size_t{1}] += after;
    gradient_[term.weight] += static_cast<float>(error) - after;
  }
}

void FanModel::Learn(const Fan& fan, FanCut truth) {
  const uint32_t n = fan.places;
  std::array<double, kMost> begins{}, ends{}, arcs{};
  double first_face = 0;  // by how much the face at place 0 belongs to the second child too rarely
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t j = 0; j < n; ++j) {
      if (i == j) continue;
      const double error = (i == truth.begin && j == truth.end ? 1 : 0) - probability_[i][j];
      begins[i] += error;
      ends[j] += error;
      arcs[j > i ? j - i - 1 : j + n - i - 1] += error;
      if (i == 0 || (i > j && j > 0)) first_face += error;
      if (fan.IsOutside(i) || fan.IsOutside(j)) continue;
      const float after = static_cast<float>(error) * bend_[i][j].share;
      gradient_[bend_[i][j].weight + size_t{1}] += after;
      gradient_[bend_[i][j].weight] += static_cast<float>(error) - after;
    }
  }
  double in_second = first_face;
  for (uint32_t k = 0; k < n; ++k) {
    if (k > 0) in_second += begins[k] - ends[k];
    Spread(face_second_[k], in_second);
    Spread(face_first_[k], -in_second);
    Spread(spoke_second_[k], in_second - begins[k]);
    Spread(spoke_first_[k], -in_second - ends[k]);
    Spread(begin_[k], begins[k]);
    Spread(end_[k], ends[k]);
    Spread(pivot_[k], begins[k] + ends[k]);
  }
  for (uint32_t m = 0; m + 1 < n; ++m) {
    gradient_[kArcSecond + std::min(m, kMostArc)] += static_cast<float>(arcs[m]);
    gradient_[kArcFirst + std::min(n - 2 - m, kMostArc)] += static_cast<float>(arcs[m]);
  }
  for (size_t w = 0; w < kStored; ++w) {
    const float slope = gradient_[w];
    if (slope == 0) continue;
    gradient_[w] = 0;
    squares_[w] = kFade * squares_[w] + slope * slope;
    weights_[w] += kStep * slope / std::sqrt(kSquares + squares_[w]);
  }
}

FanCut FanModel::TakeLikeliest(uint32_t places, double* probability) {
  double best = -1;
  FanCut cut;
  for (uint32_t i = 0; i < places; ++i) {
    for (uint32_t j = 0; j < places; ++j) {
      if (i == j || !(left_[i][j] > best)) continue;
      best = left_[i][j];
      cut = {i, j};
    }
  }
  left_[cut.begin][cut.end] = -1;
  *probability = best;
  return cut;
}

template <class Coder>
FanCut FanModel::Code(Coder& coder, const Fan& fan, std::span<const Spoke> spokes,
                      const Vector3& second, FanCut truth) {
  Measure(fan, spokes, second);
  CollectFaces(fan);
  CollectSpokes(fan);
  CollectPivots(fan, spokes);
  WeighPairs(fan);
  Weigh(fan);
  const uint32_t n = fan.places, cuts = n * (n - 1);
  const uint32_t place_bucket = std::min(n - 3, kPlaceBuckets - 1);
  double mass = 1, probability = 0;
  FanCut cut = TakeLikeliest(n, &probability);
  for (uint32_t rank = 0; rank + 1 < cuts; ++rank) {
    mass = std::max(mass - probability, kLeastMass);
    const double odds = 256 * detail::FastLog(std::max(probability, kLeastMass) / mass);
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

template FanCut FanModel::Code<BitEncoder>(BitEncoder&, const Fan&, std::span<const Spoke>,
                                           const Vector3&, FanCut);
template FanCut FanModel::Code<BitDecoder>(BitDecoder&, const Fan&, std::span<const Spoke>,
                                           const Vector3&, FanCut);

}  // namespace folprom
