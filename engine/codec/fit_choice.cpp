#include "engine/codec/fit_choice.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace folprom {
namespace {

/// A sample lies so far over a face of the LOD, which shares of 1 move towards it by so much.
struct Gap {
  double height = 0;
  std::array<double, kBends> moves{};
};

/// The part of the barycentric coordinates by which a sample may lie beside a face.
constexpr double kBeside = 0.5;
/// A change has to bring the faces nearer by this part.
constexpr double kWorth = 0.003;

/// A face around the set, the sample's place in it and its height times the normal's length.
struct Foot {
  std::array<uint32_t, 3> corners{};
  std::array<double, 3> weights{};
  Vector3 normal{};
  double inside = -kBeside;  ///< least of the weights
};

Foot FootOf(const SubtreeLod& lod, const FitSample& sample) {
  Foot best;
  const Int3& centre = lod.positions[sample.set];
  const Vector3 q = Difference(sample.position, centre);
  for (const uint32_t corner : lod.complex.Corners(sample.set)) {
    const auto [a, b] = lod.complex.Opposite(corner);
    const Vector3 to_a = Difference(lod.positions[a], centre);
    const Vector3 to_b = Difference(lod.positions[b], centre);
    const Vector3 normal = Cross(to_a, to_b);
    const double square = Dot(normal, normal);
    if (!(square > 0)) continue;
    const double of_a = Dot(Cross(q, to_b), normal) / square;
    const double of_b = Dot(Cross(to_a, q), normal) / square;
    const double rest = 1 - of_a - of_b;
    const double inside = std::min({of_a, of_b, rest});
    if (inside > best.inside) best = {{sample.set, a, b}, {rest, of_a, of_b}, normal, inside};
  }
  return best;
}

/// Measures gaps; how a set moves is worked out once.
class Gauge {
 public:
  explicit Gauge(const SubtreeLod& lod) : lod_(lod), place_(lod.size(), kUnknown) {}

  std::optional<Gap> GapOf(const FitSample& sample) {
    const Foot foot = FootOf(lod_, sample);
    if (foot.inside <= -kBeside) return std::nullopt;
    const double length = std::sqrt(Dot(foot.normal, foot.normal));
    Gap gap;
    const Vector3 q = Difference(sample.position, lod_.positions[sample.set]);
    gap.height = Dot(q, foot.normal) / length;
    for (size_t i = 0; i < 3; ++i) {
      const FitMove* move = MoveOf(foot.corners[i]);
      if (move == nullptr) continue;
      const double weight = std::clamp(foot.weights[i], 0.0, 1.0);
      double& sum = gap.moves[move->bend];
      sum = sum + weight * Dot(move->shift, foot.normal) / length;
    }
    return gap;
  }

 private:
  static constexpr uint32_t kUnknown = kNone - 1;

  const FitMove* MoveOf(uint32_t set) {
    uint32_t& place = place_[set];
    if (place == kUnknown) {
      const auto move = FitMoveOf(lod_, set);
      place = move ? static_cast<uint32_t>(moves_.size()) : kNone;
      if (move) moves_.push_back(*move);
    }
    return place == kNone ? nullptr : &moves_[place];
  }

  const SubtreeLod& lod_;
  std::vector<uint32_t> place_;  ///< in moves_, of each set; kNone: it is not moved
  std::vector<FitMove> moves_;
};

double DistanceWith(const FitShares& shares, std::span<const Gap> gaps) {
  double sum = 0;
  for (const Gap& gap : gaps) {
    double height = gap.height;
    for (size_t b = 0; b < kBends; ++b) {
      height = height - kShareStep * static_cast<double>(shares[b]) * gap.moves[b];
    }
    sum = sum + std::fabs(height);
  }
  return sum;
}

}  // namespace

FitShares ChooseFit(const SubtreeLod& lod, std::span<const FitSample> samples,
                    const FitShares& before) {
  Gauge gauge(lod);
  std::vector<Gap> gaps;
  for (const FitSample& sample : samples) {
    if (const auto gap = gauge.GapOf(sample)) gaps.push_back(*gap);
  }
  FitShares chosen = before;
  double least = DistanceWith(chosen, gaps);
  for (int sweep = 0; sweep < 2; ++sweep) {
    for (size_t bend = 0; bend < kBends; ++bend) {
      FitShares other = chosen;
      for (uint32_t share = 0; share <= kLargestShare; ++share) {
        other[bend] = share;
        const double distance = DistanceWith(other, gaps);
        if (distance >= least * (1 - kWorth)) continue;
        least = distance;
        chosen = other;
      }
    }
  }
  return chosen;
}

}  // namespace folprom
