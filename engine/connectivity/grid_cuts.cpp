#include "engine/connectivity/grid_cuts.h"

#include <algorithm>

#include "engine/entropy/bit_coder.h"

namespace folprom {

GridCuts::GridCuts() : entries_(kEntries), hit_({kMostHits + 1, kEntries}) {}

bool GridCuts::Find(const Fan& fan, const SplitStar& star, const GridHint& hint) {
  constexpr uint32_t kOutside = 3;
  std::array<uint32_t, Fan::kMostPlaces> look;
  bool found = false;
  for (uint32_t place = 0; place < fan.places; ++place) {
    look[place] = kOutside;
    if (fan.IsOutside(place)) continue;
    const uint32_t vertex = star.neighbours[fan.neighbour[place]].vertex;
    uint32_t k = 0;
    while (hint.neighbour[k] != vertex) ++k;
    look[place] = hint.mark[k];
    if (vertex != hint.far_vertex) continue;
    beyond_ = place;
    found = true;
  }
  if (!found) return false;
  uint32_t key = fan.places * 4 + hint.kind;
  for (uint32_t i = 0, place = beyond_; i < fan.places; ++i, place = fan.Next(place)) {
    key = (key * 4 + look[place]) * 2654435761U;
    key ^= key >> 15;
  }
  entry_ = key % kEntries;
  return true;
}

template <class Coder>
FanCut GridCuts::Code(Coder& coder, const Fan& fan, FanCut truth) {
  const Entry& known = entries_[entry_];
  const FanCut guess{(known.cut.begin + beyond_) % fan.places,
                     (known.cut.end + beyond_) % fan.places};
  if (guess.begin == guess.end) return {};
  const bool same = truth.begin == guess.begin && truth.end == guess.end;
  return hit_.Code(coder, {known.hits, entry_}, 0, same) ? guess : FanCut{};
}

uint8_t GridCuts::Learn(const Fan& fan, const GridHint& hint, FanCut cut) {
  const uint32_t n = fan.places;
  cut = {(cut.begin + n - beyond_) % n, (cut.end + n - beyond_) % n};
  Entry& known = entries_[entry_];
  if (known.cut.begin == cut.begin && known.cut.end == cut.end) {
    known.hits = std::min(known.hits + 1, kMostHits);
  } else if (known.hits < 2) {
    known = {cut, 0};
  } else {
    known.hits = known.hits / 2;
  }
  // The diagonal of the cells shows where one pivot is two places from the neighbour beyond and
  // the other is not.
  const bool after = cut.end == 2, before = n - cut.begin == 2;
  return after == before ? hint.kind : (after ? 1 : 2);
}

template FanCut GridCuts::Code<BitEncoder>(BitEncoder&, const Fan&, FanCut);
template FanCut GridCuts::Code<BitDecoder>(BitDecoder&, const Fan&, FanCut);

}  // namespace folprom
