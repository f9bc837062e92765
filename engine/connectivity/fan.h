// The star of a vertex as a ring: the usual case, a disc or half a disc of faces.
#pragma once

#include <array>
#include <cstdint>

#include "engine/connectivity/split_oracle.h"
#include "engine/connectivity/split_star.h"

namespace folprom {

/// The neighbours in the order of the faces around the vertex. Where the surface ends at the vertex
/// the ring is closed by one more place, the outside, which is the last.
struct Fan {
  static constexpr uint32_t kMostPlaces = 20;
  uint32_t places = 0;  ///< 0: the star is no fan
  bool open = false;
  std::array<uint32_t, kMostPlaces> neighbour;  ///< into SplitStar::neighbours; not of the outside
  std::array<uint32_t, kMostPlaces> face;  ///< between place and next, into SplitStar::faces, kNone
  uint32_t Next(uint32_t place) const { return place + 1 == places ? 0 : place + 1; }
  uint32_t Previous(uint32_t place) const { return place == 0 ? places - 1 : place - 1; }
  bool IsOutside(uint32_t place) const { return open && place + 1 == places; }
};

/// How a split parts a fan: faces and neighbours after `begin` and before `end` go to the second
/// child, the others to the first; the neighbours at both places are pivots.
struct FanCut {
  uint32_t begin = 0, end = 0;
};

/// A fan of places 3 .. kMostPlaces, or one of none when the star is anything else: its faces are
/// not all oriented alike, hang together otherwise, or have corners that are no neighbours.
Fan FindFan(const SplitStar& star);

/// The cut that the split is, places 0 and 0 when the split does anything else to the fan.
FanCut TrueCut(const Fan& fan, const SplitStar& star, const SplitOracle& oracle);

/// Tells the neighbours and faces of the star where they go.
void PartFan(const Fan& fan, FanCut cut, SplitStar* star);

}  // namespace folprom
