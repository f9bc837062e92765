// What a decoded mesh kept of its original: vertices, faces, and their order.
#pragma once

#include <cstdint>

#include "tests/bench/peers/mesh_file.h"

namespace folprom::peers {

struct Counts {
  uint64_t vertices = 0;
  uint64_t faces = 0;
};

struct Fidelity {
  Counts original, decoded;
  Counts lost;                ///< of the original, without a decoded partner of their own
  bool vertex_order = false;  ///< decoded vertex i is original vertex i, for all i
  bool face_order = false;    ///< decoded face i is original face i up to rotation, for all i

  bool same_vertices() const { return original.vertices == decoded.vertices && lost.vertices == 0; }
  bool same_connectivity() const {
    return same_vertices() && original.faces == decoded.faces && lost.faces == 0;
  }
};

/// Looks for a pairing of decoded and original vertices that lie within `tolerance` (model units,
/// above 0) on each axis and that maps faces to faces with their orientation. Whatever it reports
/// as kept is proven by the pairing found; where many vertices lie within a tolerance of each other
/// and no face tells them apart, a better pairing might exist.
Fidelity CompareWithOriginal(const Mesh& original, const Mesh& decoded, double tolerance);

}  // namespace folprom::peers
