// The current level of detail: vertices, the edges between them, and the faces on those edges.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/connectivity/block_lists.h"
#include "engine/mesh/types.h"
#include "folprom/result.h"

namespace folprom {

inline constexpr uint32_t kNone = 0xffffffff;

/// Next and previous corner of the same face.
inline uint32_t NextCorner(uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
inline uint32_t PreviousCorner(uint32_t corner) {
  return corner % 3 == 0 ? corner + 2 : corner - 1;
}

/// Of two triples of the same three vertices: do they run the same way round.
inline bool RunsAlong(const Face& face, const Face& other) {
  const size_t place = face[0] == other[0] ? 0 : (face[1] == other[0] ? 1 : 2);
  return face[(place + 1) % 3] == other[1];
}

/// Vertices, edges and faces that only ever grow in number. An edge is two half-edges, 2e and 2e+1;
/// a face has three corners, 3f .. 3f+2. Half-edges and corners of a vertex are contiguous, and
/// each knows its place there, so that it moves from one vertex to another in constant time,
/// whatever the degree of either end. The same calls give the same order.
class Complex {
 public:
  /// A half-edge as its vertex sees it.
  struct Spoke {
    uint32_t target;
    uint32_t half_edge;
  };

  uint32_t AddVertex() {
    spokes_.AddList();
    corners_of_.AddList();
    return spokes_.size() - 1;
  }
  /// Returns the edge; half-edge 2e starts at `a`.
  uint32_t AddEdge(uint32_t a, uint32_t b) {
    const uint32_t edge = edge_count();
    half_edges_.push_back({b, spokes_.Append(a, {b, 2 * edge})});
    half_edges_.push_back({a, spokes_.Append(b, {a, 2 * edge + 1})});
    return edge;
  }
  /// Returns the face.
  uint32_t AddFace(uint32_t a, uint32_t b, uint32_t c) {
    const uint32_t face = face_count();
    for (uint32_t vertex : {a, b, c}) {
      const uint32_t corner = static_cast<uint32_t>(corners_.size());
      corners_.push_back({vertex, corners_of_.Append(vertex, corner)});
    }
    return face;
  }
  /// The half-edge that starts at `from` now starts at `to`.
  void MoveHalfEdge(uint32_t half_edge, uint32_t from, uint32_t to) {
    HalfEdge& moved = half_edges_[half_edge];
    half_edges_[spokes_.Of(from).back().half_edge].place = moved.place;
    spokes_.Remove(from, moved.place);
    moved.place = spokes_.Append(to, {moved.target, half_edge});
    HalfEdge& twin = half_edges_[half_edge ^ 1];
    twin.target = to;
    spokes_.At(moved.target, twin.place).target = to;
  }
  void MoveCorner(uint32_t corner, uint32_t from, uint32_t to) {
    Corner& moved = corners_[corner];
    corners_[corners_of_.Of(from).back()].place = moved.place;
    corners_of_.Remove(from, moved.place);
    moved = {to, corners_of_.Append(to, corner)};
  }
  /// The face of the corner runs the other way round.
  void TurnFace(uint32_t corner) {
    const uint32_t next = NextCorner(corner), previous = PreviousCorner(corner);
    std::swap(corners_[next], corners_[previous]);
    for (const uint32_t moved : {next, previous}) {
      corners_of_.At(corners_[moved].vertex, corners_[moved].place) = moved;
    }
  }

  uint32_t vertex_count() const { return spokes_.size(); }
  uint32_t edge_count() const { return static_cast<uint32_t>(half_edges_.size() / 2); }
  uint32_t face_count() const { return static_cast<uint32_t>(corners_.size() / 3); }
  /// Valid until the next change.
  std::span<const Spoke> Spokes(uint32_t vertex) const { return spokes_.Of(vertex); }
  std::span<const uint32_t> Corners(uint32_t vertex) const { return corners_of_.Of(vertex); }
  /// Asks for the memory of where a vertex's lists are, once that is there of the lists, and then
  /// of the faces.
  void PrefetchVertex(uint32_t vertex) const {
    spokes_.PrefetchList(vertex);
    corners_of_.PrefetchList(vertex);
  }
  void PrefetchStar(uint32_t vertex) const {
    spokes_.Prefetch(vertex);
    corners_of_.Prefetch(vertex);
  }
  void PrefetchFaces(uint32_t vertex) const {
    for (const uint32_t corner : Corners(vertex)) __builtin_prefetch(&corners_[corner]);
  }
  void PrefetchEdge(uint32_t half_edge) const { __builtin_prefetch(&half_edges_[half_edge]); }
  /// Number of edges.
  uint32_t Degree(uint32_t vertex) const { return spokes_.SizeOf(vertex); }
  uint32_t VertexOf(uint32_t corner) const { return corners_[corner].vertex; }
  /// The two others of the corner's face, in the order of its orientation.
  std::array<uint32_t, 2> Opposite(uint32_t corner) const {
    // Places are as good as random: a table is read where a branch would be guessed wrongly.
    constexpr std::array<uint32_t, 3> kNext{1, 2, 0}, kPrevious{2, 0, 1};
    const uint32_t first = corner / 3 * 3, place = corner - first;
    return {corners_[first + kNext[place]].vertex, corners_[first + kPrevious[place]].vertex};
  }
  /// The three vertices of a face in the order of its orientation.
  Face face(uint32_t index) const {
    return {corners_[3 * index].vertex, corners_[3 * index + 1].vertex,
            corners_[3 * index + 2].vertex};
  }
  /// The two ends of an edge.
  std::array<uint32_t, 2> edge(uint32_t index) const {
    return {half_edges_[2 * index + 1].target, half_edges_[2 * index].target};
  }

 private:
  struct HalfEdge {
    uint32_t target;
    uint32_t place;  ///< among the spokes of the vertex where it starts
  };
  struct Corner {
    uint32_t vertex;
    uint32_t place;  ///< among the vertex's corners
  };

  BlockLists<Spoke> spokes_;
  BlockLists<uint32_t> corners_of_;
  std::vector<HalfEdge> half_edges_;
  std::vector<Corner> corners_;
};

/// Throws Failure kCorrupt when a complex has more faces, or edges, than `mesh_faces` faces allow.
inline void CheckSize(const Complex& complex, uint64_t mesh_faces) {
  if (complex.face_count() > mesh_faces || complex.edge_count() > 3 * mesh_faces) {
    throw Failure(ErrorKind::kCorrupt, "more faces or edges coded than the table announces");
  }
}

}  // namespace folprom
