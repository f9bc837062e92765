#include "engine/geometry/tangent_density.h"

#include <algorithm>
#include <cmath>

namespace folprom {
namespace {

/// Between cells that a step of 2 would part, in spacings.
constexpr double kStep = 0.1;
constexpr float kLearning = 0.1F;
/// Of the weight of all; a third of the groups of four cells has less.
constexpr float kLeastPart = 1.0F / 4096;

/// Squared distances in spacings to buckets: fine where vertices are near.
LaneIntegers DistanceBuckets(Lanes squared, float last) {
  const Lanes bucket = LesserOf(22 * squared, 3.68F + 12 * squared);
  return WholeOf(LesserOf(bucket, AllLanes(last)));
}

double Flat(const Vector3& normal, uint32_t axis) {
  double flat = 1 - normal[axis] * normal[axis];
  return flat > 0.01 ? flat : 0.01;
}

}  // namespace

TangentDensity::TangentDensity(uint32_t step)
    : place_(kEccentricities * kCounts), far_(kCounts), pair_(kCounts) {
  // Cells between two places share their weight, and so would be sharper than what is learnt.
  reach_ = step == 1 ? 0.75 * kStep : kStep * step / 2;
  constexpr int kHalfAlong = kAlong / 2, kHalfAside = kAside / 2;
  const int skip = static_cast<int>(step);
  const int most_along = 2 * kHalfAlong / skip * skip, most_aside = 2 * kHalfAside / skip * skip;
  half_along_ = static_cast<float>(kStep / 2 * most_along);
  half_aside_ = static_cast<float>(kStep / 2 * most_aside);
  for (int a = -most_along; a <= most_along; a += skip) {
    for (int b = -most_aside; b <= most_aside; b += skip) {
      along_[cells_ / kLanes][cells_ % kLanes] = static_cast<float>(kStep * (a / 2.0));
      aside_[cells_ / kLanes][cells_ % kLanes] = static_cast<float>(kStep * (b / 2.0));
      const int place = (a / 2 + kHalfAlong) * (kHalfAside + 1) + (b < 0 ? -b : b) / 2;
      place_of_[cells_++] = static_cast<uint16_t>(place);
    }
  }
  groups_ = (cells_ + kLanes - 1) / kLanes;
  for (uint32_t k = cells_; k < groups_ * kLanes; ++k) {
    along_[k / kLanes][k % kLanes] = aside_[k / kLanes][k % kLanes] = 0;
    place_of_[k] = 0;
  }
  for (auto& table : place_) table.fill(0);
  for (auto& table : far_) table.fill(0);
  for (auto& table : pair_) table.fill({});
}

void TangentDensity::Visit(LearnedStateVisitor& visitor) {
  constexpr float kUnit = 1.0F / 32;
  for (auto& table : place_) visitor.Values(table, kUnit);
  for (auto& table : far_) visitor.Values(table, kUnit);
  for (auto& tables : pair_) {
    for (auto& table : tables) visitor.Values(table, kUnit);
  }
}

void TangentDensity::Prepare(const RingShape& ring, const Vector3& ahead) {
  spacing_ = ring.spacing;
  normal_ = ring.normal;
  const double height = Dot(ahead, ring.normal), inverse = 1 / spacing_;
  Vector3 along{0, 0, 0};
  for (size_t i = 0; i < 3; ++i) along[i] = ahead[i] - height * ring.normal[i];
  const double length = std::sqrt(Dot(along, along));
  eccentricity_ = static_cast<float>(length * inverse);
  if (eccentricity_ > 1e-6F) {
    for (double& value : along) value = value / length;
  } else {
    along = ring.tangent;
  }
  along_axis_ = along;
  aside_axis_ = Cross(ring.normal, along);
  count_context_ = ring.count < 6 ? 0 : (ring.count < 8 ? 1 : (ring.count < 10 ? 2 : 3));
  constexpr float kLastEccentricity = kEccentricities - 1;
  context_ = static_cast<uint32_t>(std::min(eccentricity_ / 0.2F, kLastEccentricity)) * kCounts +
             count_context_;
  neighbours_ = std::min(ring.count, kMostNeighbours);
  std::array<std::array<float, 2>, kMostNeighbours> place;
  for (uint32_t n = 0; n < neighbours_; ++n) {
    const Vector3 d = ring.spokes[n].way();
    const float u = static_cast<float>(Dot(d, along) * inverse);
    const float v = static_cast<float>(Dot(d, aside_axis_) * inverse);
    place[n] = {u, v};
    constexpr float kLastRing = kRingBuckets - 1;
    ring_bucket_[n] = static_cast<uint8_t>(std::min((u * u + v * v) * 3, kLastRing));
  }
  Weigh(place);
}

TangentDensity::PairRows TangentDensity::RowsOfNeighbours() {
  PairRows rows;
  for (uint32_t n = 0; n < neighbours_; ++n) {
    rows[n] = pair_[count_context_][ring_bucket_[n]].data();
  }
  return rows;
}

void TangentDensity::Weigh(const std::array<std::array<float, 2>, kMostNeighbours>& neighbours) {
  const auto& table = place_[context_];
  const auto& far = far_[count_context_];
  for (uint32_t g = 0; g < groups_; ++g) {
    const Lanes u = eccentricity_ + along_[g], v = aside_[g];
    const uint32_t k = g * kLanes;
    far_bucket_[g] = DistanceBuckets(u * u + v * v, kFarBuckets - 1);
    weight_[g] = LookUp(far.data(), far_bucket_[g]) +
                 Lanes{table[place_of_[k]], table[place_of_[k + 1]], table[place_of_[k + 2]],
                       table[place_of_[k + 3]]};
  }
  const PairRows pair = RowsOfNeighbours();
  for (uint32_t n = 0; n < neighbours_; ++n) {
    LaneIntegers* const bucket = near_bucket_[n];
    const Lanes to_u = AllLanes(neighbours[n][0]), to_v = AllLanes(neighbours[n][1]);
    for (uint32_t g = 0; g < groups_; ++g) {
      const Lanes du = eccentricity_ + along_[g] - to_u, dv = aside_[g] - to_v;
      bucket[g] = DistanceBuckets(du * du + dv * dv, kNearBuckets - 1);
    }
    for (uint32_t g = 0; g < groups_; ++g) weight_[g] = weight_[g] + LookUp(pair[n], bucket[g]);
  }
  Lanes total = AllLanes(0);
  for (uint32_t g = 0; g < groups_; ++g) {
    weight_[g] = FastExp2(LesserOf(GreaterOf(weight_[g], AllLanes(-30)), AllLanes(30)));
    if (g + 1 == groups_) {
      for (uint32_t lane = cells_ - g * kLanes; lane < kLanes; ++lane) weight_[g][lane] = 0;
    }
    total = total + weight_[g];
  }
  LeaveOutUnlikely(kLeastPart * SumOf(total));
}

void TangentDensity::LeaveOutUnlikely(float least) {
  Lanes total = AllLanes(0);
  likely_count_ = 0;
  for (uint32_t g = 0; g < groups_; ++g) {
    if (SumOf(weight_[g]) < least) continue;
    likely_[likely_count_++] = static_cast<uint16_t>(g);
    total = total + weight_[g];
  }
  total_ = SumOf(total);
}

Lanes TangentDensity::CentreOn(uint32_t axis, uint32_t group) const {
  const float u = static_cast<float>(spacing_ * along_axis_[axis]);
  const float v = static_cast<float>(spacing_ * aside_axis_[axis]);
  return (eccentricity_ + along_[group]) * u + aside_[group] * v;
}

double TangentDensity::WidthOn(uint32_t axis) const {
  return reach_ * spacing_ * std::sqrt(Flat(normal_, axis));
}

void TangentDensity::First(uint32_t axis, AxisDensity* density) const {
  const double middle = spacing_ * static_cast<double>(eccentricity_) * along_axis_[axis];
  const double side = spacing_ * (static_cast<double>(half_along_) * std::fabs(along_axis_[axis]) +
                                  static_cast<double>(half_aside_) * std::fabs(aside_axis_[axis]));
  density->Start(middle - side, middle + side, WidthOn(axis));
  for (const uint32_t g : Likely()) density->Add(CentreOn(axis, g), weight_[g]);
  density->Finish();
}

void TangentDensity::Second(uint32_t axis, uint32_t first, double first_offset,
                            AxisDensity* density) {
  const double slope = -normal_[first] * normal_[axis] / Flat(normal_, first);
  const double left = Flat(normal_, axis) - slope * slope * Flat(normal_, first);
  second_width_ = reach_ * spacing_ * std::sqrt(left > 0.01 ? left : 0.01);
  const float per_width = static_cast<float>(1 / WidthOn(first));
  const float offset = static_cast<float>(first_offset);
  possible_count_ = 0;
  float lo = 1e30F, hi = -1e30F;
  for (const uint32_t g : Likely()) {
    const Lanes miss = offset - CentreOn(first, g);
    const Lanes share = 1 - Magnitude(miss) * per_width;
    const Lanes mass = weight_[g] * share;
    const Lanes mean = CentreOn(axis, g) + static_cast<float>(slope) * miss;
    for (uint32_t lane = 0; lane < kLanes; ++lane) {
      possible_[possible_count_] = {g * kLanes + lane, mean[lane], mass[lane]};
      if (mass[lane] > 0) ++possible_count_;
    }
  }
  for (uint32_t i = 0; i < possible_count_; ++i) {
    lo = std::min(lo, possible_[i].mean);
    hi = std::max(hi, possible_[i].mean);
  }
  if (possible_count_ == 0) {
    lo = hi = static_cast<float>(spacing_ * static_cast<double>(eccentricity_) * along_axis_[axis]);
  }
  density->Start(static_cast<double>(lo), static_cast<double>(hi), second_width_);
  for (uint32_t i = 0; i < possible_count_; i += kLanes) {
    Lanes mean = AllLanes(lo), mass = AllLanes(0);
    for (uint32_t lane = 0; lane < kLanes && i + lane < possible_count_; ++lane) {
      mean[lane] = possible_[i + lane].mean;
      mass[lane] = possible_[i + lane].mass;
    }
    density->Add(mean, mass);
  }
  density->Finish();
}

void TangentDensity::Learn(double second_offset) {
  const float offset = static_cast<float>(second_offset);
  const float per_width = static_cast<float>(1 / second_width_);
  float found = 0;
  for (uint32_t i = 0; i < possible_count_; ++i) {
    Possible& cell = possible_[i];
    cell.mass *= std::max(0.0F, 1 - std::fabs(offset - cell.mean) * per_width);
    found += cell.mass;
  }
  if (!(found > 0)) return;
  const float expected = -kLearning / total_, seen = kLearning / found;
  for (const uint32_t g : Likely()) weight_[g] = weight_[g] * expected;
  for (uint32_t i = 0; i < possible_count_; ++i) {
    const Possible& cell = possible_[i];
    weight_[cell.cell / kLanes][cell.cell % kLanes] += seen * cell.mass;
  }
  auto& table = place_[context_];
  auto& far = far_[count_context_];
  const PairRows pair = RowsOfNeighbours();
  for (const uint32_t g : Likely()) {
    for (uint32_t lane = 0; lane < kLanes; ++lane) {
      const float surprise = weight_[g][lane];
      table[place_of_[g * kLanes + lane]] += 2 * surprise;
      far[static_cast<size_t>(far_bucket_[g][lane])] += surprise;
      for (uint32_t n = 0; n < neighbours_; ++n) {
        pair[n][near_bucket_[n][g][lane]] += surprise;
      }
    }
  }
}

}  // namespace folprom
