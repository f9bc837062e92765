#include "engine/codec/due_coder.h"

#include <cmath>

#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

/// With it the spacing that stands for a distortion is about the spacing of the sets that have it.
constexpr double kDistortionScale = 1.4;
/// Asking goes on while so many wait for each that is due: the surface is flat beside its features.
constexpr double kWaitingPerDue = 1.6;
/// It ends when so few are due.
constexpr double kLeastDue = 0.02;
/// Or when so many times the always asked are live.
constexpr double kMostAsked = 4;

}  // namespace

DueCoder::DueCoder(const DueSettings& settings) : settings_(settings), still_asking_({1}) {}

template <class Coder>
bool DueCoder::CodeAsking(Coder& coder, double least_spacing, const SubtreeLod& lod,
                          std::span<const uint32_t> open, const SubtreeTruth* truth) {
  ++step_;
  least_spacing_ = least_spacing;
  const auto live = static_cast<double>(lod.size());
  const bool is_asked = least_spacing > 0 && (lod.size() > 1 || settings_.ask_root);
  if (is_asked && live < settings_.always) {
    asking_ = true;
  } else if (is_asked && asking_ && live <= kMostAsked * settings_.always) {
    bool pays = false;
    if constexpr (Coder::kEncoding) pays = Pays(lod, open, *truth);
    asking_ = still_asking_.Code(coder, {0}, 0, pays);
  } else {
    asking_ = false;
  }
  return asking_;
}

template <class Coder>
bool DueCoder::CodeDue(Coder& coder, SubtreeLod& lod, SetStar* star, double spacing,
                       const SubtreeTruth* truth) {
  const uint32_t set = star->set;
  bool due = false;
  if constexpr (Coder::kEncoding) due = IsDue(*truth, set);
  due = model_.Code(coder, SignsOf(lod, star, spacing), due);
  lod.sets[set].asked = due ? 0 : step_;
  return due;
}

bool DueCoder::Pays(const SubtreeLod& lod, std::span<const uint32_t> open,
                    const SubtreeTruth& truth) const {
  uint32_t waiting = 0, due = 0;
  for (uint32_t set : open) {
    if (IsDue(truth, set)) {
      ++due;
    } else if (lod.Spacing(set) >= least_spacing_) {
      ++waiting;
    }
  }
  return waiting >= kWaitingPerDue * due && due >= kLeastDue * waiting;
}

bool DueCoder::IsDue(const SubtreeTruth& truth, uint32_t set) const {
  // Distortion grows with the fourth power of the spacing.
  const double fourth = kDistortionScale * truth.Distortion(set) * settings_.longest;
  return std::sqrt(std::sqrt(fourth)) >= least_spacing_;
}

DueSigns DueCoder::SignsOf(const SubtreeLod& lod, SetStar* star, double spacing) const {
  const uint32_t set = star->set;
  DueSigns signs;
  signs.spacing = spacing / least_spacing_;
  signs.scale = static_cast<double>(lod.sets[set].scale) / least_spacing_;
  lod.MeasureFaces(star);
  const RingPlane ring = lod.PlaneAt(*star);
  const double fourth = ring.spacing * ring.spacing * ring.height_range * settings_.longest;
  signs.distortion = std::sqrt(std::sqrt(fourth)) / least_spacing_;
  signs.asked = lod.sets[set].asked + 1 == step_;
  for (const auto& spoke : lod.complex.Spokes(set)) {
    const SetRecord& other = lod.sets[spoke.target];
    if (other.is_leaf) continue;
    if (other.asked == step_) ++signs.waiting;
    if (other.asked == 0) ++signs.split;
  }
  return signs;
}

#define FOLPROM_INSTANTIATE(Coder)                                                           \
  template bool DueCoder::CodeAsking<Coder>(Coder&, double, const SubtreeLod&,               \
                                            std::span<const uint32_t>, const SubtreeTruth*); \
  template bool DueCoder::CodeDue<Coder>(Coder&, SubtreeLod&, SetStar*, double,              \
                                         const SubtreeTruth*);
FOLPROM_INSTANTIATE(BitEncoder)
FOLPROM_INSTANTIATE(BitDecoder)
#undef FOLPROM_INSTANTIATE

}  // namespace folprom
