// Which sets a SubtreeCoder splits in a layer, and in which order.
#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "engine/codec/subtree_coder.h"
#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

/// Brings the values of these ranks, ascending, to their places; `first` is that of values[0].
void PlaceRanks(std::span<float> values, size_t first, std::span<const size_t> ranks) {
  if (ranks.empty()) return;
  const size_t middle = ranks.size() / 2, place = ranks[middle] - first;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(place),
                   values.end());
  PlaceRanks(values.first(place), first, ranks.first(middle));
  auto behind = ranks.subspan(middle);
  while (!behind.empty() && behind[0] == ranks[middle]) behind = behind.subspan(1);
  PlaceRanks(values.subspan(place + 1), first + place + 1, behind);
}

}  // namespace

template <class Coder>
void SubtreeCoder::CodeSplits(Coder& coder, SubtreeTruth* truth, CostMeters* meters) {
  const LayerSchedule& schedule = parameters_.schedule;
  if (schedule.BeginsStep(layer_)) {
    const double least_spacing = schedule.SplitSpacing(layer_);
    coder.SetMeter(&meters->split);
    asking_ = due_.CodeAsking(coder, least_spacing, lod_, open_, truth);
    if (asking_) {
      BeginShares(least_spacing);
    } else {
      BeginRounds(least_spacing);
    }
  }
  if (asking_) {
    CodeShare(coder, truth, meters);
    return;
  }
  for (uint32_t i = 0; i < schedule.rounds(layer_) && !round_spacings_.empty(); ++i) {
    CodeRound(coder, round_spacings_.back(), truth, meters);
    round_spacings_.pop_back();
  }
}

void SubtreeCoder::BeginRounds(double least_spacing) {
  round_spacings_.assign(1, least_spacing);
  RememberSpacings();
  const LayerSchedule& schedule = parameters_.schedule;
  const size_t rounds = size_t{schedule.rounds(layer_)} * (schedule.parts_left(layer_) + 1);
  // What a grid expects holds where neighbours are split one after the other, large or not: its
  // step is one round, of the first layer.
  if (rounds == 1 || grid_) return;
  std::vector<float> large;
  for (size_t i = 0; i < open_.size(); ++i) {
    float& spacing = open_spacings_[i];
    if (static_cast<double>(spacing) < least_spacing) continue;
    spacing = static_cast<float>(lod_.Spacing(open_[i]));
    lod_.sets[open_[i]].spacing = spacing;
    if (static_cast<double>(spacing) >= least_spacing) large.push_back(spacing);
  }
  std::vector<size_t> ranks;
  for (size_t round = 1; round < rounds; ++round) ranks.push_back(large.size() * round / rounds);
  if (!large.empty()) PlaceRanks(large, 0, ranks);
  for (const size_t rank : ranks) {
    round_spacings_.push_back(large.empty() ? least_spacing : static_cast<double>(large[rank]));
  }
}

void SubtreeCoder::RememberSpacings() {
  open_spacings_.resize(open_.size());
  for (size_t i = 0; i < open_.size(); ++i) open_spacings_[i] = lod_.sets[open_[i]].spacing;
}

void SubtreeCoder::PrefetchBehind(size_t place, double least_spacing,
                                  const SubtreeTruth* truth) const {
  constexpr size_t kRecord = 9, kStar = 6, kRing = 3;
  const auto is_due = [&](size_t i) {
    return static_cast<double>(open_spacings_[i]) >= least_spacing;
  };
  if (place + kRecord >= open_.size()) return;
  if (is_due(place + kRecord)) {
    lod_.PrefetchRecord(open_[place + kRecord]);
    if (truth != nullptr) truth->PrefetchSet(open_[place + kRecord]);
  }
  if (is_due(place + kStar)) {
    lod_.PrefetchStar(open_[place + kStar]);
    if (truth != nullptr) truth->PrefetchNode(open_[place + kStar]);
  }
  if (is_due(place + kRing)) {
    lod_.PrefetchRing(open_[place + kRing]);
    if (truth != nullptr) truth->PrefetchChildren(open_[place + kRing]);
  }
}

template <class Coder>
void SubtreeCoder::CodeRound(Coder& coder, double least_spacing, SubtreeTruth* truth,
                             CostMeters* meters) {
  if (grid_) {
    OrderAlongSurface();
    RememberSpacings();
  }
  // Children that are still large enough join the end of the list and the same round.
  size_t kept = 0;
  for (size_t i = 0; i < open_.size(); ++i) {
    const uint32_t set = open_[i];
    PrefetchBehind(i, least_spacing, truth);
    // Spacings fall as neighbours split, so one that was too small before is not measured again.
    float known = open_spacings_[i];
    if (static_cast<double>(known) >= least_spacing) {
      const double spacing = lod_.MeasureSpokes(set, &star_);
      known = lod_.sets[set].spacing = static_cast<float>(spacing);
      if (spacing >= least_spacing) {
        CodeSet(coder, set, spacing, truth, meters);
        for (size_t child = open_spacings_.size(); child < open_.size(); ++child) {
          open_spacings_.push_back(lod_.sets[open_[child]].spacing);
        }
        continue;
      }
    }
    open_[kept] = set;
    open_spacings_[kept++] = known;
  }
  open_.resize(kept);
  open_spacings_.resize(kept);
}

void SubtreeCoder::BeginShares(double least_spacing) {
  if (grid_) OrderAlongSurface();
  share_ = {};
  for (uint32_t set : open_) share_.large.push_back(lod_.Spacing(set) >= least_spacing);
}

template <class Coder>
void SubtreeCoder::CodeShare(Coder& coder, SubtreeTruth* truth, CostMeters* meters) {
  const uint32_t parts_left = parameters_.schedule.parts_left(layer_);
  const auto begin = open_.begin() + static_cast<std::ptrdiff_t>(share_.waiting);
  const std::vector<uint32_t> sets(begin, open_.end());
  open_.resize(share_.waiting);
  size_t large = static_cast<size_t>(std::count(share_.large.begin(), share_.large.end(), true)) /
                 (parts_left + 1);
  size_t taken = 0;
  while (taken < sets.size() && (parts_left == 0 || large > 0)) {
    if (share_.large[taken]) --large;
    AskFamily(coder, sets[taken++], truth, meters);
  }
  const auto rest = static_cast<std::ptrdiff_t>(taken);
  share_.waiting = open_.size();
  open_.insert(open_.end(), sets.begin() + rest, sets.end());
  share_.large.erase(share_.large.begin(), share_.large.begin() + rest);
}

template <class Coder>
void SubtreeCoder::AskFamily(Coder& coder, uint32_t set, SubtreeTruth* truth, CostMeters* meters) {
  const size_t waiting = open_.size();
  family_.assign(1, set);
  for (size_t i = 0; i < family_.size(); ++i) {
    const uint32_t member = family_[i];
    const double spacing = lod_.MeasureSpokes(member, &star_);
    coder.SetMeter(&meters->split);
    if (lod_.size() > 1 && !due_.CodeDue(coder, lod_, &star_, spacing, truth)) {
      asked_.push_back(member);
      continue;
    }
    CodeSet(coder, member, spacing, truth, meters);
    family_.insert(family_.end(), open_.begin() + static_cast<std::ptrdiff_t>(waiting),
                   open_.end());
    open_.resize(waiting);
  }
  open_.insert(open_.end(), asked_.begin(), asked_.end());
  asked_.clear();
}

void SubtreeCoder::OrderAlongSurface() {
  const Complex& complex = lod_.complex;
  std::vector<uint8_t> state(lod_.size(), 0);  // 1: open, 2: open and reached, 3: reached
  for (uint32_t set : open_) state[set] = 1;
  std::vector<uint32_t> reached, ordered;
  for (uint32_t start : open_) {
    if (state[start] != 1) continue;
    state[start] = 2;
    reached.assign(1, start);
    for (size_t i = 0; i < reached.size(); ++i) {
      const uint32_t set = reached[i];
      if (state[set] == 2) ordered.push_back(set);
      for (const auto& [other, half_edge] : complex.Spokes(set)) {
        if (state[other] >= 2) continue;
        state[other] = state[other] == 1 ? 2 : 3;
        reached.push_back(other);
      }
    }
  }
  open_ = std::move(ordered);
}

template void SubtreeCoder::CodeSplits<BitEncoder>(BitEncoder&, SubtreeTruth*, CostMeters*);
template void SubtreeCoder::CodeSplits<BitDecoder>(BitDecoder&, SubtreeTruth*, CostMeters*);

}  // namespace folprom
