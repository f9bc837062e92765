#include "engine/connectivity/fan_features.h"

#include <algorithm>
#include <bit>

namespace folprom {
namespace {

constexpr float kMostKnot = FanFeatures::kKnots - 1;

/// -1 .. 1, steep around 0, as a knot.
Lanes SqueezedKnot(Lanes x) {
  return (x / (1 + Magnitude(x)) + 1) * (kMostKnot / 2);
}

Lanes Cotangent(Lanes dot, Lanes cross) { return dot / GreaterOf(cross, AllLanes(1e-9F)); }

/// The knots of those places alone where `has` is 1.
Lanes Where(Lanes has, Lanes knot) { return has > 0.5F ? knot : AllLanes(-1); }

template <class Vectors>
Lanes Dot(const Vectors& a, const Vectors& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// log2 with straight lines between powers of two.
float RoughLog2(float x) {
  const uint32_t bits = std::bit_cast<uint32_t>(x);
  return static_cast<float>(bits) * (1.0F / (1 << 23)) - 127;
}

}  // namespace

void FanFeatures::Triangles::Close(uint32_t places) {
  x.Close(places);
  y.Close(places);
  z.Close(places);
  length.Close(places);
}

FanFeatures::Vectors FanFeatures::NormalsAt(const Triangles& t, uint32_t group) {
  return {t.x.At(group), t.y.At(group), t.z.At(group)};
}

FanFeatures::Vectors FanFeatures::NormalsBefore(const Triangles& t, uint32_t group) {
  return {t.x.Before(group), t.y.Before(group), t.z.Before(group)};
}

void FanFeatures::SetTriangles(Vectors a, Vectors b, uint32_t group, Triangles* triangles) {
  const Lanes x = a.y * b.z - a.z * b.y, y = a.z * b.x - a.x * b.z, z = a.x * b.y - a.y * b.x;
  const Vectors side{b.x - a.x, b.y - a.y, b.z - a.z};
  const Lanes length = SquareRoot(x * x + y * y + z * z);
  const Lanes squares = Dot(a, a) + Dot(b, b) + Dot(side, side);
  triangles->x.Set(group, x);
  triangles->y.Set(group, y);
  triangles->z.Set(group, z);
  triangles->length.Set(group, length);
  triangles->shape[group] = 3.4641016F * length / GreaterOf(squares, AllLanes(1e-30F));
}

/// A knot: 0 where two triangles lie flat beside each other, the last where they lie on each other.
Lanes FanFeatures::Bend(const Vectors& a, Lanes a_length, const Vectors& b, Lanes b_length) {
  const Lanes lengths = a_length * b_length;
  const Lanes cosine = lengths > 0 ? Dot(a, b) / lengths : AllLanes(-1);
  const Lanes half = GreaterOf((1 - cosine) * 0.5F, AllLanes(0));
  return SquareRoot(SquareRoot(half)) * kMostKnot;
}

void FanFeatures::PlaceNeighbours(std::span<const FanSpoke> spokes) {
  const uint32_t last = groups_ * kLanes;
  for (uint32_t k = 0; k < last; ++k) {
    const bool real = is_real_[k / kLanes][k % kLanes] > 0;
    const FanSpoke spoke = real ? spokes[k] : FanSpoke{{0, 0, 0}, 0, 0, false, 0};
    first_x_.SetPlace(k, static_cast<float>(spoke.position[0]));
    first_y_.SetPlace(k, static_cast<float>(spoke.position[1]));
    first_z_.SetPlace(k, static_cast<float>(spoke.position[2]));
    degree_.SetPlace(k, static_cast<float>(spoke.degree));
    const float age = static_cast<float>(spoke.age) * (kAgeKnots - 1);
    age_.SetPlace(k, age + (spoke.younger ? kAgeKnots : 0));
    const float octaves = RoughLog2(1 + static_cast<float>(spoke.splits_past));
    rest_.SetPlace(k, std::min(octaves, 19.0F) * ((kAgeKnots - 1) / 19.0F));
  }
  first_x_.Close(places_);
  first_y_.Close(places_);
  first_z_.Close(places_);
}

void FanFeatures::MeasureNewTriangles(uint32_t g, const Vectors& second) {
  const Vectors to{first_x_.At(g), first_y_.At(g), first_z_.At(g)};
  const Vectors from{to.x - second.x, to.y - second.y, to.z - second.z};
  second_x_.Set(g, from.x);
  second_y_.Set(g, from.y);
  second_z_.Set(g, from.z);
  SetTriangles(second, to, g, &of_both_);
  const Lanes length = of_both_.length.At(g);
  at_first_[g] = Cotangent(Dot(second, to), length);
  at_second_[g] = Cotangent(-Dot(second, from), length);
  at_pivot_[g] = Cotangent(Dot(to, from), length);
}

void FanFeatures::MeasureFaces(uint32_t g) {
  const Vectors first{first_x_.At(g), first_y_.At(g), first_z_.At(g)};
  const Vectors first_next{first_x_.After(g), first_y_.After(g), first_z_.After(g)};
  const Vectors second{second_x_.At(g), second_y_.At(g), second_z_.At(g)};
  const Vectors second_next{second_x_.After(g), second_y_.After(g), second_z_.After(g)};
  const Vectors side{first_next.x - first.x, first_next.y - first.y, first_next.z - first.z};
  SetTriangles(first, first_next, g, &of_first_);
  SetTriangles(second, second_next, g, &of_second_);
  const Lanes has = face_here_[g];
  normal_x_ = normal_x_ + has * of_first_.x.At(g);
  normal_y_ = normal_y_ + has * of_first_.y.At(g);
  normal_z_ = normal_z_ + has * of_first_.z.At(g);
  const Lanes first_length = of_first_.length.At(g), second_length = of_second_.length.At(g);
  first_at_.Set(g, Cotangent(-Dot(side, first), first_length));
  first_at_next_.Set(g, Cotangent(Dot(side, first_next), first_length));
  second_at_.Set(g, Cotangent(-Dot(side, second), second_length));
  second_at_next_.Set(g, Cotangent(Dot(side, second_next), second_length));
}

void FanFeatures::CollectFaces(uint32_t g) {
  const Vectors normal{AllLanes(SumOf(normal_x_)), AllLanes(SumOf(normal_y_)),
                       AllLanes(SumOf(normal_z_))};
  const Lanes has = face_here_[g], none = AllLanes(-1), turned = AllLanes(0);
  knot_[kFaceFirstShape][g] = Where(has, of_first_.shape[g] * kMostKnot);
  knot_[kFaceSecondShape][g] = Where(has, of_second_.shape[g] * kMostKnot);
  const Lanes first = has * Dot(NormalsAt(of_first_, g), normal);
  const Lanes second = has * Dot(NormalsAt(of_second_, g), normal);
  knot_[kFaceFirstTurned][g] = first < 0 ? turned : none;
  knot_[kFaceSecondTurned][g] = second < 0 ? turned : none;
  // The new triangle (first, second, neighbour) has the orientation of the fan at the end of the
  // second child's part, the opposite at its beginning.
  const Lanes is_new = is_real_[g], both = is_new * Dot(NormalsAt(of_both_, g), normal);
  knot_[kBeginShape][g] = knot_[kEndShape][g] = Where(is_new, of_both_.shape[g] * kMostKnot);
  knot_[kBeginTurned][g] = both > 0 ? turned : none;
  knot_[kEndTurned][g] = both < 0 ? turned : none;
}

void FanFeatures::CollectSpokes(uint32_t g) {
  const Vectors to{first_x_.At(g), first_y_.At(g), first_z_.At(g)};
  const Vectors from{second_x_.At(g), second_y_.At(g), second_z_.At(g)};
  const Lanes nearer = Dot(to, to) - Dot(from, from);
  const Lanes lean = Where(is_real_[g], SqueezedKnot(nearer / spacing2_));
  knot_[kSpokeFirstLean][g] = knot_[kSpokeSecondLean][g] = lean;
  const Lanes inside = face_here_[g] * has_face_.Before(g);
  const Lanes angles = first_at_.Before(g) + first_at_next_.At(g);
  knot_[kSpokeFirstAngles][g] = Where(inside, SqueezedKnot(angles));
  knot_[kSpokeFirstBend][g] =
      Where(inside, Bend(NormalsBefore(of_first_, g), of_first_.length.Before(g),
                         NormalsAt(of_first_, g), of_first_.length.At(g)));
  knot_[kSpokeSecondBend][g] =
      Where(inside, Bend(NormalsBefore(of_second_, g), of_second_.length.Before(g),
                         NormalsAt(of_second_, g), of_second_.length.At(g)));
}

void FanFeatures::CollectPivots(uint32_t g) {
  const Lanes real = is_real_[g], length = of_both_.length.At(g);
  knot_[kPivotDegree][g] = Where(real, degree_.At(g));
  knot_[kPivotAge][g] = Where(real, age_.At(g));
  knot_[kPivotRest][g] = Where(real, rest_.At(g));
  knot_[kPivotAngle][g] = Where(real, SqueezedKnot(at_pivot_[g]));
  const Lanes before = has_face_.Before(g) * real, after = face_here_[g] * real;
  const Vectors both = NormalsAt(of_both_, g);
  knot_[kBeginAnglesBefore][g] = Where(before, SqueezedKnot(at_second_[g] + first_at_.Before(g)));
  knot_[kEndAnglesBefore][g] = Where(before, SqueezedKnot(at_first_[g] + second_at_.Before(g)));
  knot_[kEndBend][g] = Where(before, Bend(both, length, NormalsBefore(of_second_, g),
                                          of_second_.length.Before(g)));
  knot_[kBeginAnglesAfter][g] = Where(after, SqueezedKnot(at_first_[g] + second_at_next_.At(g)));
  knot_[kEndAnglesAfter][g] = Where(after, SqueezedKnot(at_second_[g] + first_at_next_.At(g)));
  const Vectors turned{-both.x, -both.y, -both.z};
  knot_[kBeginBend][g] =
      Where(after, Bend(turned, length, NormalsAt(of_second_, g), of_second_.length.At(g)));
}

void FanFeatures::Measure(const Fan& fan, std::span<const FanSpoke> spokes, const Vector3& second) {
  places_ = fan.places;
  groups_ = (places_ + kLanes - 1) / kLanes;
  spacing2_ = static_cast<float>(std::max(folprom::Dot(second, second), 0.25));
  for (uint32_t k = 0; k < groups_ * kLanes; ++k) {
    const bool there = k < places_;
    is_real_[k / kLanes][k % kLanes] = there && !fan.IsOutside(k) ? 1 : 0;
    has_face_.SetPlace(k, there && fan.face[k] != kNone ? 1 : 0);
  }
  for (uint32_t g = 0; g < groups_; ++g) face_here_[g] = has_face_.At(g);
  has_face_.Close(places_);
  PlaceNeighbours(spokes);
  const Vectors child{AllLanes(static_cast<float>(second[0])),
                      AllLanes(static_cast<float>(second[1])),
                      AllLanes(static_cast<float>(second[2]))};
  for (uint32_t g = 0; g < groups_; ++g) MeasureNewTriangles(g, child);
  second_x_.Close(places_);
  second_y_.Close(places_);
  second_z_.Close(places_);
  normal_x_ = normal_y_ = normal_z_ = AllLanes(0);
  for (uint32_t g = 0; g < groups_; ++g) MeasureFaces(g);
  of_first_.Close(places_);
  of_second_.Close(places_);
  first_at_.Close(places_);
  second_at_.Close(places_);
  for (uint32_t g = 0; g < groups_; ++g) {
    CollectFaces(g);
    CollectSpokes(g);
    CollectPivots(g);
  }
}

Lanes FanFeatures::PairKnot(uint32_t first, uint32_t group) const {
  if (!(is_real_[first / kLanes][first % kLanes] > 0)) return AllLanes(-1);
  const Vectors one{AllLanes(-of_both_.x.Of(first)), AllLanes(-of_both_.y.Of(first)),
                    AllLanes(-of_both_.z.Of(first))};
  const Lanes bend = Bend(one, AllLanes(of_both_.length.Of(first)), NormalsAt(of_both_, group),
                          of_both_.length.At(group));
  return Where(is_real_[group], bend);
}

}  // namespace folprom
