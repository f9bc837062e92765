// A mesh as the coders of order see it: the same in encoder and decoder, whatever the scan's order.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/mesh/types.h"
#include "engine/order/work_space.h"

namespace folprom {

/// No vertex, no face.
inline constexpr uint32_t kNoNumber = 0xffffffffu;

/// Vertices and faces that the orders of a mesh can be coded of: three corners a face fit into 32
/// bits.
inline constexpr uint64_t kMostOrdered = 0xffffffffu / 3;

/// The face with its smallest corner first (of two such, the one before the smaller corner); by how
/// many corners it was turned.
inline uint32_t TurnToSmallest(Face* face) {
  const Face& f = *face;
  const Face turned[3] = {f, {f[1], f[2], f[0]}, {f[2], f[0], f[1]}};
  const uint32_t turns = static_cast<uint32_t>(std::ranges::min_element(turned) - turned);
  *face = turned[turns];
  return turns;
}

/// Failure kLimit, naming `file`, where there are more of either.
void CheckOrderable(uint64_t vertices, uint64_t faces, const std::string& file);

/// Vertices are numbered along a space-filling curve, faces begin with their smallest corner and
/// are sorted. Borrows everything.
struct OrderMesh {
  std::span<const Int3> positions;
  std::span<const Face> faces;
  std::span<const uint32_t> star_begin;  ///< of each vertex, and the end of the last
  std::span<const uint32_t> stars;       ///< faces of each vertex, ascending, each once

  uint32_t vertex_count() const { return static_cast<uint32_t>(positions.size()); }
  uint32_t face_count() const { return static_cast<uint32_t>(faces.size()); }
  /// At most `most` faces of a vertex: a vertex may have any number.
  std::span<const uint32_t> Star(uint32_t vertex, uint32_t most) const {
    const uint32_t begin = star_begin[vertex], end = star_begin[vertex + 1];
    return stars.subspan(begin, std::min(end - begin, most));
  }
  /// Of a face turned in any way; the first of equal ones, and where there is none the next.
  uint32_t NumberOf(Face face) const;
  std::vector<uint32_t> Numbers(std::span<const Face> some) const;
};

/// The numbers of vertices along the curve: [i] is the place of vertex i among `positions`, those
/// of a subtree. Coincident vertices follow each other in the order of their `numbers`.
std::vector<uint32_t> CurvePlaces(std::span<const Int3> positions,
                                  std::span<const uint32_t> numbers);

/// Makes the mesh of its positions and its faces in any order, turned in any way. Memory beside
/// that of these is taken from the space. At most kMostOrdered vertices and faces.
OrderMesh MakeOrderMesh(std::span<const Int3> positions, std::span<const Face> faces,
                        WorkSpace& space);

}  // namespace folprom
