#include "engine/connectivity/fan.h"

#include <utility>

namespace folprom {
namespace {

/// Goes once around the fan from the cut's beginning: visit(place, side of the face after it).
template <class Visit>
void GoAround(const Fan& fan, FanCut cut, Visit visit) {
  Side side = kSecond;
  for (uint32_t step = 0, place = cut.begin; step < fan.places; ++step, place = fan.Next(place)) {
    if (place == cut.end) side = kFirst;
    visit(place, side);
  }
}

bool IsPivot(FanCut cut, uint32_t place) { return place == cut.begin || place == cut.end; }

bool Holds(const Fan& fan, FanCut cut, const SplitStar& star, const SplitOracle& oracle) {
  bool holds = true;
  GoAround(fan, cut, [&](uint32_t place, Side side) {
    if (fan.face[place] != kNone) {
      holds = holds && oracle.FaceSide(star.faces[fan.face[place]].corner / 3) == side;
    }
    if (fan.IsOutside(place)) return;
    const auto& neighbour = star.neighbours[fan.neighbour[place]];
    const bool pivot = IsPivot(cut, place);
    holds = holds &&
            oracle.NeighbourSide(neighbour.half_edge, neighbour.vertex) == (pivot ? kBoth : side);
    if (!pivot) return;
    holds = holds && oracle.HasNewFace(neighbour.vertex) &&
            oracle.NewFaceForward(neighbour.vertex) == (place == cut.end);
  });
  return holds;
}

}  // namespace

Fan FindFan(const SplitStar& star) {
  Fan fan;
  const size_t count = star.neighbours.size();
  const bool open = star.faces.size() + 1 == count;
  if (star.faces.size() != count && !open) return fan;
  if (count + (open ? 1 : 0) < 3 || count + (open ? 1 : 0) > Fan::kMostPlaces) return fan;
  std::array<uint32_t, Fan::kMostPlaces> leaving, entering;  // faces by the neighbour at an end
  leaving.fill(kNone);
  entering.fill(kNone);
  for (uint32_t f = 0; f < star.faces.size(); ++f) {
    const auto& end = star.faces[f].end;
    if (end[0] == kNone || end[1] == kNone) return fan;
    if (leaving[end[0]] != kNone || entering[end[1]] != kNone) return fan;
    leaving[end[0]] = entering[end[1]] = f;
  }
  uint32_t at = 0;
  while (open && entering[at] != kNone) {
    if (++at == count) return fan;
  }
  for (uint32_t place = 0; place < count; ++place) {
    const uint32_t face = leaving[at];
    fan.neighbour[place] = at;
    fan.face[place] = face;
    // All neighbours are met when the way along the faces does not end, or close, too early.
    if (place + 1 == count) {
      if (open ? face != kNone : star.faces[face].end[1] != fan.neighbour[0]) return fan;
      break;
    }
    if (face == kNone) return fan;
    at = star.faces[face].end[1];
    if (at == fan.neighbour[0]) return fan;
  }
  fan.open = open;
  fan.places = static_cast<uint32_t>(count);
  if (open) fan.face[fan.places++] = kNone;
  return fan;
}

FanCut TrueCut(const Fan& fan, const SplitStar& star, const SplitOracle& oracle) {
  if (!oracle.connected()) return {};
  FanCut cut;
  uint32_t pivots = 0;
  for (uint32_t place = 0; place < fan.places; ++place) {
    if (fan.IsOutside(place)) continue;
    const auto& neighbour = star.neighbours[fan.neighbour[place]];
    if (oracle.NeighbourSide(neighbour.half_edge, neighbour.vertex) != kBoth) continue;
    (pivots == 0 ? cut.begin : cut.end) = place;
    ++pivots;
  }
  if (fan.open && pivots == 1) {
    cut.end = fan.places - 1;
    pivots = 2;
  }
  if (pivots != 2) return {};
  if (Holds(fan, cut, star, oracle)) return cut;
  std::swap(cut.begin, cut.end);
  return Holds(fan, cut, star, oracle) ? cut : FanCut{};
}

void PartFan(const Fan& fan, FanCut cut, SplitStar* star) {
  GoAround(fan, cut, [&](uint32_t place, Side side) {
    if (fan.face[place] != kNone) star->faces[fan.face[place]].side = side;
    if (fan.IsOutside(place)) return;
    star->neighbours[fan.neighbour[place]].side = IsPivot(cut, place) ? kBoth : side;
  });
}

}  // namespace folprom
