// What surrounds a vertex that is about to be split, and where each part of it goes.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/connectivity/complex.h"

namespace folprom {

/// To which child a neighbour or a face belongs after the split. A neighbour of both is a pivot.
enum Side : uint8_t { kUndecided = 0, kFirst = 1, kSecond = 2, kBoth = 3 };

/// Of a face that goes to both children: does that of either run the other way round.
struct FaceTurns {
  bool first = false, second = false;
};

/// The star of a split vertex. Filled by SplitCoder::Gather and
/// LinkFaces, decided by SplitCoder::Code.
struct SplitStar {
  struct Neighbour {
    uint32_t vertex;
    uint32_t half_edge;           ///< starts at the split vertex
    uint32_t first_face = kNone;  ///< list of link entries, 2 * index into faces + end
    uint32_t face_count = 0;
    uint32_t new_edge = kNone;  ///< edge to the second child, when pivot
    uint32_t new_face = kNone;  ///< face (first child, second child, vertex), when it exists
    uint32_t regularity = 0;    ///< order of pivots, smaller is more regular
    int32_t lean = 0;  ///< position between the children, 1/256 of their distance: < 0 first's side
    Side side = kUndecided;
    uint16_t faces_first = 0;  ///< star faces here that go to the first child, at most 2
    uint16_t faces_second = 0;
    int8_t votes = 0;  ///< for orientation (first, second, vertex), minus those against
  };
  struct StarFace {
    uint32_t corner;  ///< the split vertex's corner
    uint32_t end[2];  ///< next and previous vertex of the face: index into neighbours or kNone
    uint32_t next_link[2] = {kNone, kNone};  ///< next link entry at that end
    uint32_t new_face = kNone;               ///< the second child's copy, when it goes to both
    Side side = kUndecided;
    FaceTurns turns = {};  ///< when it goes to both
  };
  uint32_t vertex = kNone;  ///< the split vertex; the first child keeps its index
  uint32_t second = kNone;  ///< index of the second child
  bool connected = false;   ///< are the children connected
  uint32_t child_edge = kNone;
  std::vector<Neighbour> neighbours;
  std::vector<StarFace> faces;
};

}  // namespace folprom
