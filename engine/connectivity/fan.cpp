#include "engine/connectivity/fan.h"

namespace folprom {

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

}  // namespace folprom
