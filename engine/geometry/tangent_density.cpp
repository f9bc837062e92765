#include "engine/geometry/tangent_density.h"

#include <algorithm>
#include <cmath>

#include "engine/entropy/cell_model.h"

namespace folprom {
namespace {

/// Between cells that a step of 2 would part, in spacings.
constexpr double kStep = 0.1;
constexpr float kLearning = 0.1F;

/// Squared distance in spacings to a bucket: fine where vertices are near.
uint8_t DistanceBucket(double squared, uint32_t count) {
  double bucket = squared < 0.36 ? 22 * squared : 8 + 12 * (squared - 0.36);
  return static_cast<uint8_t>(std::min(bucket, static_cast<double>(count - 1)));
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
  for (int a = -most_along; a <= most_along; a += skip) {
    for (int b = -most_aside; b <= most_aside; b += skip) {
      const int place = (a / 2 + kHalfAlong) * (kHalfAside + 1) + (b < 0 ? -b : b) / 2;
      cells_.push_back({kStep * (a / 2.0), kStep * (b / 2.0), static_cast<uint16_t>(place)});
    }
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
  double height = Dot(ahead, ring.normal);
  Vector3 along{0, 0, 0};
  for (size_t i = 0; i < 3; ++i) along[i] = ahead[i] - height * ring.normal[i];
  double length = std::sqrt(Dot(along, along));
  double inverse = 1 / spacing_, eccentricity = length * inverse;
  if (eccentricity > 1e-6) {
    for (double& value : along) value = value / length;
  } else {
    along = ring.tangent;
  }
  Vector3 aside = Cross(ring.normal, along);
  count_context_ = ring.count < 6 ? 0 : (ring.count < 8 ? 1 : (ring.count < 10 ? 2 : 3));
  context_ = static_cast<uint32_t>(std::min(eccentricity / 0.2, kEccentricities - 1.0)) * kCounts +
             count_context_;
  neighbours_ = std::min<size_t>(ring.count, kMostNeighbours);
  std::array<std::array<double, 2>, kMostNeighbours> place;
  for (size_t n = 0; n < neighbours_; ++n) {
    const Vector3& d = ring.around[n];
    place[n] = {Dot(d, along) * inverse, Dot(d, aside) * inverse};
    double far = place[n][0] * place[n][0] + place[n][1] * place[n][1];
    ring_bucket_[n] = static_cast<uint8_t>(std::min(far * 3, kRingBuckets - 1.0));
  }
  const auto& table = place_[context_];
  const auto& far = far_[count_context_];
  const PairTable& pair = pair_[count_context_];
  double total = 0;
  for (size_t k = 0; k < cells_.size(); ++k) {
    const Cell& cell = cells_[k];
    const double u = eccentricity + cell.along, v = cell.aside;
    for (size_t i = 0; i < 3; ++i) centre_[k][i] = spacing_ * (u * along[i] + v * aside[i]);
    far_bucket_[k] = DistanceBucket(u * u + v * v, kFarBuckets);
    float score = table[cell.place] + far[far_bucket_[k]];
    for (size_t n = 0; n < neighbours_; ++n) {
      double du = u - place[n][0], dv = v - place[n][1];
      uint8_t bucket = DistanceBucket(du * du + dv * dv, kNearBuckets);
      near_bucket_[k][n] = bucket;
      score = score + pair[ring_bucket_[n]][bucket];
    }
    weight_[k] = detail::FastExp2(std::clamp(static_cast<double>(score), -30.0, 30.0));
    total = total + weight_[k];
  }
  for (size_t k = 0; k < cells_.size(); ++k) weight_[k] = weight_[k] / total;
}

double TangentDensity::WidthOn(uint32_t axis) const {
  return reach_ * spacing_ * std::sqrt(Flat(normal_, axis));
}

void TangentDensity::First(uint32_t axis, AxisDensity* density) const {
  double lo = centre_[0][axis], hi = lo, width = WidthOn(axis);
  for (size_t k = 0; k < cells_.size(); ++k) {
    lo = std::min(lo, centre_[k][axis]);
    hi = std::max(hi, centre_[k][axis]);
  }
  density->Start(lo - width, hi + width);
  for (size_t k = 0; k < cells_.size(); ++k) density->Add(centre_[k][axis], width, weight_[k]);
  density->Finish();
}

void TangentDensity::Second(uint32_t axis, uint32_t first, double first_offset,
                            AxisDensity* density) {
  first_axis_ = first;
  second_axis_ = axis;
  first_offset_ = first_offset;
  double width = WidthOn(first);
  slope_ = -normal_[first] * normal_[axis] / Flat(normal_, first);
  double left = Flat(normal_, axis) - slope_ * slope_ * Flat(normal_, first);
  second_width_ = reach_ * spacing_ * std::sqrt(left > 0.01 ? left : 0.01);
  double lo = 1e300, hi = -1e300;
  for (size_t k = 0; k < cells_.size(); ++k) {
    double miss = std::fabs(first_offset - centre_[k][first]) / width;
    conditional_[k] = miss < 1 ? weight_[k] * (1 - miss) : weight_[k] * 1e-6;
    if (miss >= 1) continue;
    double mean = centre_[k][axis] + slope_ * (first_offset - centre_[k][first]);
    lo = std::min(lo, mean);
    hi = std::max(hi, mean);
  }
  if (lo > hi) lo = hi = centre_[cells_.size() / 2][axis];
  density->Start(lo - second_width_, hi + second_width_);
  for (size_t k = 0; k < cells_.size(); ++k) {
    if (std::fabs(first_offset - centre_[k][first]) >= width) continue;
    double mean = centre_[k][axis] + slope_ * (first_offset - centre_[k][first]);
    density->Add(mean, second_width_, conditional_[k]);
  }
  density->Finish();
}

void TangentDensity::Learn(double second_offset) {
  double total = 0;
  for (size_t k = 0; k < cells_.size(); ++k) {
    double mean = centre_[k][second_axis_] + slope_ * (first_offset_ - centre_[k][first_axis_]);
    double miss = std::fabs(second_offset - mean) / second_width_;
    conditional_[k] = miss < 1 ? conditional_[k] * (1 - miss) : 0;
    total = total + conditional_[k];
  }
  if (!(total > 0)) return;
  auto& table = place_[context_];
  auto& far = far_[count_context_];
  PairTable& pair = pair_[count_context_];
  for (size_t k = 0; k < cells_.size(); ++k) {
    float surprise = kLearning * static_cast<float>(conditional_[k] / total - weight_[k]);
    table[cells_[k].place] += 2 * surprise;
    far[far_bucket_[k]] += surprise;
    for (size_t n = 0; n < neighbours_; ++n) {
      pair[ring_bucket_[n]][near_bucket_[k][n]] += surprise;
    }
  }
}

}  // namespace folprom
