#include "engine/geometry/spoke_model.h"

#include <algorithm>
#include <cmath>

namespace folprom {
namespace {

constexpr std::array<float, 3> kFraction{1.0F / 2, 1.0F / 3, 1.0F / 4};
/// Half width of a kernel, lattice units.
constexpr float kWidth = 0.15F;
/// Where fewer vertices than this part lie on spokes, only one in so many is looked at.
constexpr float kRare = 0.006F;
constexpr uint32_t kLooks = 8;
/// How likely kinds of places are counts beside each other alone, so it is told in sixteenths of a
/// vertex, as finely as taught statistics are. A kind that never was right may yet be.
constexpr double kLikelyUnit = 16, kFirstLikely = 0.32, kLeastLikely = 0.0032;
/// Neighbours of other lengths, in spacings, are of other kinds.
constexpr double kKindsPerSpacing = 2.5;

float ShareOf(const std::array<float, 2>& counts) { return counts[1] / (counts[0] + counts[1]); }

}  // namespace

SpokeModel::SpokeModel()
    : likely_(kFractions * kLengths, kFirstLikely), on_spokes_{5, 1}, straight_{1, 1} {}

void SpokeModel::Visit(LearnedStateVisitor& visitor) { likely_.Visit(visitor); }

void SpokeModel::Start(const RingShape& ring) {
  step_ = started_ = groups_ = 0;
  const float share = ShareOf(on_spokes_);
  if (share < kRare && ++skipped_ % kLooks != 0) return;
  const uint32_t neighbours = std::min(ring.count, kMostNeighbours);
  const double per_spacing = kKindsPerSpacing / ring.spacing;
  std::array<float, kMostPlaces> weight{};
  std::array<std::array<float, kMostPlaces>, 3> at{};
  float sum = 0;
  for (uint32_t n = 0; n < neighbours; ++n) {
    const Vector3 d = ring.spokes[n].way();
    const double length = std::sqrt(Dot(d, d)) * per_spacing;
    const uint32_t bucket = static_cast<uint32_t>(std::min(length, kLengths - 1.0));
    for (uint32_t f = 0; f < kFractions; ++f) {
      const uint32_t kind = f * kLengths + bucket;
      for (size_t i = 0; i < 3; ++i) at[i][started_] = static_cast<float>(d[i]) * kFraction[f];
      weight[started_] = static_cast<float>(std::max(likely_.Of(kind), kLeastLikely));
      sum = sum + weight[started_];
      kind_[started_++] = static_cast<uint8_t>(kind);
    }
  }
  if (started_ == 0) return;
  groups_ = (started_ + kLanes - 1) / kLanes;
  for (uint32_t g = 0; g < groups_; ++g) {
    for (size_t i = 0; i < 3; ++i) at_[i][g] = LoadLanes(&at[i][g * kLanes]);
    weight_[g] = LoadLanes(&weight[g * kLanes]) * (share / sum);
  }
  other_weight_ = static_cast<double>(1 - share);
}

Lanes SpokeModel::BelowLessAbove(uint32_t group, int64_t cell) const {
  const float end = static_cast<float>((cell << shift_) - old_) - 0.5F;
  const Lanes beside = end - at_[axis_][group];
  return beside / (kWidth + Magnitude(beside));
}

void SpokeModel::Begin(uint32_t axis, uint32_t shift, int64_t a, int64_t c, int32_t old) {
  axis_ = axis;
  shift_ = shift;
  old_ = old;
  if (groups_ > 0 && step_ == 2) ExpectStraight();
  for (uint32_t g = 0; g < groups_; ++g) {
    first_[g] = BelowLessAbove(g, a);
    last_[g] = BelowLessAbove(g, c);
  }
}

uint32_t SpokeModel::Weigh(int64_t at, uint32_t probability) {
  if (groups_ == 0) return probability;
  Lanes above = AllLanes(0), all = AllLanes(0);
  for (uint32_t g = 0; g < groups_; ++g) {
    here_[g] = BelowLessAbove(g, at);
    above = above + weight_[g] * GreaterOf(last_[g] - here_[g], AllLanes(0));
    all = all + weight_[g] * GreaterOf(last_[g] - first_[g], AllLanes(0));
  }
  other_ = static_cast<double>(probability) / 65536;
  const double both = other_weight_ * other_ + static_cast<double>(SumOf(above)) / 2;
  const double whole = other_weight_ + static_cast<double>(SumOf(all)) / 2;
  return static_cast<uint32_t>(std::clamp(65536 * (both / whole), 16.0, 65520.0));
}

void SpokeModel::Learn(bool above) {
  if (groups_ == 0) return;
  other_weight_ = other_weight_ * (above ? other_ : 1 - other_);
  for (uint32_t g = 0; g < groups_; ++g) (above ? first_ : last_)[g] = here_[g];
}

void SpokeModel::End() {
  if (groups_ > 0) Settle();
  if (started_ > 0 && step_ == 1) LearnPlaces();
  if (started_ > 0 && step_ == 2) LearnStraight();
  ++step_;
}

void SpokeModel::Settle() {
  Lanes all = AllLanes(0);
  for (uint32_t g = 0; g < groups_; ++g) {
    weight_[g] = weight_[g] * GreaterOf(last_[g] - first_[g], AllLanes(0)) * 0.5F;
    all = all + weight_[g];
  }
  const double sum = static_cast<double>(SumOf(all)) + other_weight_;
  constexpr double kLeastSum = 1e-30;  // its inverse is a float
  if (sum < kLeastSum) {
    for (uint32_t g = 0; g < groups_; ++g) weight_[g] = AllLanes(0);
    groups_ = 0;
    other_weight_ = 1;
    return;
  }
  const Lanes per_sum = AllLanes(static_cast<float>(1 / sum));
  other_weight_ = other_weight_ / sum;
  for (uint32_t g = 0; g < groups_; ++g) weight_[g] = weight_[g] * per_sum;
}

void SpokeModel::LearnPlaces() {
  constexpr float kFade = 0.98F, kLeast = 0.1F;
  on_spoke_ = 1 - other_weight_;
  const auto on = static_cast<float>(on_spoke_);
  on_spokes_[0] = std::max(on_spokes_[0] * kFade + 1 - on, kLeast);
  on_spokes_[1] = std::max(on_spokes_[1] * kFade + on, kLeast);
  for (uint32_t i = 0; i < started_; ++i) {
    likely_.Learn(kind_[i], kLikelyUnit * static_cast<double>(weight_[i / kLanes][i % kLanes]));
  }
}

void SpokeModel::ExpectStraight() {
  const float straight = ShareOf(straight_);
  other_weight_ = other_weight_ + static_cast<double>(1 - straight) * on_spoke_;
  for (uint32_t g = 0; g < groups_; ++g) weight_[g] = weight_[g] * straight;
}

void SpokeModel::LearnStraight() {
  constexpr float kFade = 0.01F, kLeast = 0.05F;
  const double part = std::min((1 - other_weight_) / std::max(on_spoke_, 1e-9), 1.0);
  const auto so = static_cast<float>(part), on = static_cast<float>(on_spoke_);
  // As much as it was on a spoke at all.
  straight_[0] = std::max(straight_[0] * (1 - kFade * on) + on * (1 - so), kLeast);
  straight_[1] = std::max(straight_[1] * (1 - kFade * on) + on * so, kLeast);
}

}  // namespace folprom
