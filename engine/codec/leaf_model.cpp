#include "engine/codec/leaf_model.h"

#include <algorithm>
#include <array>

#include "engine/entropy/bit_coder.h"
#include "engine/entropy/cell_model.h"

namespace folprom {
namespace {

constexpr double kPerLog2 = 1.44269504;
constexpr uint32_t kFine = 128, kCoarse = 40;  ///< eighths of octaves of the spacing, and halves
constexpr uint32_t kRatios = 64;
constexpr uint32_t kShares = 6, kBends = 6, kCounts = 5;

uint32_t Octaves(double length, double per_octave, uint32_t count) {
  if (!(length > 1)) return 0;
  const double value = per_octave * kPerLog2 * detail::FastLog(length);
  return static_cast<uint32_t>(std::min(value, static_cast<double>(count - 1)));
}

/// Twelfths of octaves around 32; 1: a length is missing.
uint32_t Ratio(double a, double b) {
  if (!(a > 0) || !(b > 0)) return 1;
  const double value = 32 + 12 * kPerLog2 * detail::FastLog(a / b);
  return static_cast<uint32_t>(std::clamp(value, 2.0, kRatios - 1.0));
}

/// Half octaves above 1.
uint32_t RoughSize(double length) {
  return static_cast<uint32_t>(
      std::clamp<int64_t>(detail::RoughLog2<1>(length, 1), 0, int64_t{kCoarse} - 1));
}
/// Twelfths of octaves around 32; 1: a length is missing.
uint32_t RoughRatio(double a, double b) {
  if (!(a > 0) || !(b > 0)) return 1;
  return static_cast<uint32_t>(
      std::clamp<int64_t>(32 + (12 * detail::RoughLog2<12>(a, b) >> 12), 2, int64_t{kRatios} - 1));
}

/// 0: no neighbours, 1: none or hardly one is a leaf, 2 .. 5: about a fourth less than so many are.
uint32_t ShareOfLeaves(const LeafSigns& signs) {
  const uint32_t count = signs.leaves + signs.others;
  if (count == 0) return 0;
  if (signs.leaves == 0) return 1;
  return static_cast<uint32_t>(std::min(uint64_t{5} * signs.leaves / (count + 1) + 1, uint64_t{5}));
}

}  // namespace

LeafModel::LeafModel(bool light)
    : model_({kFine, kCounts * kCounts * kCoarse, kRatios * kShares, kRatios * kShares, kRatios * 4,
              kRatios / 4 * 16 * kBends},
             kShares) {
  if (light) {
    light_.emplace(std::array{kCounts * kCounts * kCoarse, kRatios * kShares, kRatios * 4},
                   kShares);
  }
}

template <class Coder>
bool LeafModel::Code(Coder& coder, const LeafSigns& signs, bool leaf) {
  const uint32_t leaves = std::min(signs.leaves, kCounts - 1);
  const uint32_t others = std::min(signs.others, kCounts - 1);
  const uint32_t share = ShareOfLeaves(signs);
  const uint32_t counts = (leaves * kCounts + others) * kCoarse;
  const uint32_t few = std::min(share, 3u);
  if (light_) {
    const uint32_t ratio = signs.leaves == 0 ? 0 : RoughRatio(signs.spacing, signs.leaf_spacing);
    return light_->Code(coder,
                        {counts + RoughSize(signs.spacing), ratio * kShares + share,
                         RoughRatio(signs.spacing, signs.scale) * 4 + few},
                        share, leaf);
  }
  const uint32_t fine = Octaves(signs.spacing, 8, kFine);
  const uint32_t coarse = Octaves(signs.spacing, 2, kCoarse);
  const uint32_t ratio = signs.leaves == 0 ? 0 : Ratio(signs.spacing, signs.leaf_spacing);
  const uint32_t reach = signs.leaves == 0 ? 0 : Ratio(signs.leaf_distance, signs.leaf_spacing);
  const uint32_t made = Ratio(signs.spacing, signs.scale);
  const auto bend = static_cast<uint32_t>(std::min(signs.bend * 8, kBends - 1.0));
  return model_.Code(coder,
                     {fine, counts + coarse, ratio * kShares + share, reach * kShares + share,
                      made * 4 + few, (ratio / 4 * 16 + fine / 8) * kBends + bend},
                     share, leaf);
}

template bool LeafModel::Code<BitEncoder>(BitEncoder&, const LeafSigns&, bool);
template bool LeafModel::Code<BitDecoder>(BitDecoder&, const LeafSigns&, bool);

}  // namespace folprom
