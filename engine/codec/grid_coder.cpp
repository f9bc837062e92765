#include "engine/codec/grid_coder.h"

#include <algorithm>
#include <cmath>

#include "engine/entropy/bit_coder.h"
#include "engine/geometry/buckets.h"

namespace folprom {

GridCoder::GridCoder(const Int3& lo, const Int3& hi)
    : lo_{lo.x, lo.y, lo.z},
      hi_{hi.x, hi.y, hi.z},
      leaf_({4 * 4 * 5, 16 * 64, 16 * 64}),
      position_({3 * kSupports * 16, 16 * 16, 3 * 6 * 4}),
      fit_(kSupports, OnlineRegression<3>({0.3, 0.5, 0.1})),
      follow_(3, OnlineRegression<2>({0, 0})),
      scale_(3 * kSupports * 2, 1) {
  pattern_.AddRoot();
}

template <class Coder>
bool GridCoder::CodeLeaf(Coder& coder, const SubtreeLod& lod, uint32_t set, double spacing,
                         const GridHint& hint, bool leaf) {
  const GridPeers peers = pattern_.PeersOf(lod.complex, lod.positions, set,
                                           [&](uint32_t other) { return lod.sets[other].is_leaf; });
  const uint32_t expects = hint.found ? 1 + hint.support : 0;
  const uint32_t known = std::min(peers.leaves, 3u) * 4 + std::min(peers.split, 3u);
  const double octaves = 8 * 1.44269504 * detail::FastLog(std::max(spacing, 1.0));
  const auto fine = static_cast<uint32_t>(std::min(octaves, 63.0));
  const double ratio =
      32 + 12 * 1.44269504 *
               detail::FastLog(std::max(spacing, 0.1) /
                               std::max(static_cast<double>(lod.sets[set].scale), 0.1));
  const auto made = static_cast<uint32_t>(std::clamp(ratio, 0.0, 63.0));
  return leaf_.Code(coder, {known * 5 + expects, known * 64 + fine, known * 64 + made}, 0, leaf);
}

template <class Coder>
Int3 GridCoder::CodePosition(Coder& coder, const Int3& old, const GridHint& hint,
                             const Int3& truth) {
  Int3 result;
  const double size = std::max(std::sqrt(Dot(hint.step, hint.step)), 0.5), inverse = 1 / size;
  const uint32_t level = OctaveBucket(size / 16);
  OnlineRegression<3>& fit = fit_[hint.support];
  std::array<double, 2> before{};  // misses on the axes before, in steps
  for (uint32_t axis = 0; axis < 3; ++axis) {
    const double origin = static_cast<double>(At(old, axis)) + 0.5;
    const auto feature = [&](double value) { return std::clamp(value * inverse, -64.0, 64.0); };
    const std::array<double, 3> features{feature(hint.far[axis]), feature(hint.step[axis]),
                                         feature(hint.across[axis])};
    const double expected = fit.Predict(features) * size;
    OnlineRegression<2>& follow = follow_[axis];
    const double told = std::clamp(follow.Predict(before), -64.0, 64.0) * size;
    const std::array<double, 2> means{expected + told, hint.far[axis] / 2 + told};
    std::array<CellPrediction, 2> predictions;
    const uint32_t place = (axis * kSupports + hint.support) * 2;
    for (uint32_t p = 0; p < 2; ++p) {
      const double scale = kScalePerMiss * scale_.Of(place + p) * size;
      predictions[p] = {origin + means[p], std::max(scale, 0.05)};
    }
    constexpr std::array<double, 5> kMissBounds{0.03, 0.07, 0.12, 0.2, 0.4};
    const double missed = std::max(std::fabs(before[0]), std::fabs(before[1]));
    const uint32_t doubt = OctaveBucket(8 * std::fabs(means[0] - means[1]) * inverse);
    const std::array<uint32_t, 3> contexts{
        (axis * kSupports + hint.support) * 16 + level, doubt * 16 + level,
        (axis * 6 + Bucket(missed, kMissBounds)) * 4 + level / 4};
    const int32_t value =
        position_.Code(coder, contexts, predictions, lo_[axis], hi_[axis], At(truth, axis));
    At(result, axis) = value;
    const double place_now = static_cast<double>(At(result, axis)) + 0.5 - origin;
    for (uint32_t p = 0; p < 2; ++p) {
      scale_.Learn(place + p, std::fabs(place_now - means[p]) * inverse);
    }
    const double missed_now = std::clamp((place_now - expected) * inverse, -1.0, 1.0);
    if (axis > 0) follow.Learn(before, missed_now);
    if (axis < 2) before[axis] = missed_now;
    fit.Learn(features, std::clamp(place_now * inverse, -64.0, 64.0));
  }
  return result;
}

#define FOLPROM_INSTANTIATE(Coder)                                                      \
  template bool GridCoder::CodeLeaf<Coder>(Coder&, const SubtreeLod&, uint32_t, double, \
                                           const GridHint&, bool);                      \
  template Int3 GridCoder::CodePosition<Coder>(Coder&, const Int3&, const GridHint&, const Int3&);
FOLPROM_INSTANTIATE(BitEncoder)
FOLPROM_INSTANTIATE(BitDecoder)
#undef FOLPROM_INSTANTIATE

}  // namespace folprom
