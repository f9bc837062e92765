// The current level of detail: vertices, the edges between them, and the faces on those edges.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/mesh/types.h"
#include "folprom/result.h"

namespace folprom {

inline constexpr uint32_t kNone = 0xffffffff;

/// Vertices, edges and faces that only ever grow in number. An edge is two half-edges, 2e and 2e+1;
/// a face has three corners, 3f .. 3f+2. Half-edges and corners of a vertex are doubly linked
/// lists, so each moves from one vertex to another in constant time, whatever the degree of either
/// end. Lists are in order of insertion at the front: the same calls give the same order.
class Complex {
 public:
  struct HalfEdge {
    uint32_t target;
    uint32_t next;
    uint32_t previous;
  };
  struct Corner {
    uint32_t vertex;
    uint32_t next;
    uint32_t previous;
  };

  uint32_t AddVertex() {
    heads_.push_back({kNone, kNone, 0});
    return static_cast<uint32_t>(heads_.size() - 1);
  }
  /// Returns the edge; half-edge 2e starts at `a`.
  uint32_t AddEdge(uint32_t a, uint32_t b) {
    uint32_t edge = static_cast<uint32_t>(half_edges_.size() / 2);
    half_edges_.push_back({b, kNone, kNone});
    half_edges_.push_back({a, kNone, kNone});
    LinkHalfEdge(2 * edge, a);
    LinkHalfEdge(2 * edge + 1, b);
    return edge;
  }
  /// Returns the face.
  uint32_t AddFace(uint32_t a, uint32_t b, uint32_t c) {
    uint32_t face = static_cast<uint32_t>(corners_.size() / 3);
    for (uint32_t vertex : {a, b, c}) corners_.push_back({vertex, kNone, kNone});
    for (uint32_t i = 0; i < 3; ++i) LinkCorner(3 * face + i, corners_[3 * face + i].vertex);
    return face;
  }
  /// The half-edge that starts at `from` now starts at `to`.
  void MoveHalfEdge(uint32_t half_edge, uint32_t from, uint32_t to) {
    const HalfEdge& moved = half_edges_[half_edge];
    if (moved.previous == kNone) {
      heads_[from].half_edge = moved.next;
    } else {
      half_edges_[moved.previous].next = moved.next;
    }
    if (moved.next != kNone) half_edges_[moved.next].previous = moved.previous;
    --heads_[from].degree;
    LinkHalfEdge(half_edge, to);
    half_edges_[half_edge ^ 1].target = to;
  }
  void MoveCorner(uint32_t corner, uint32_t from, uint32_t to) {
    Corner& moved = corners_[corner];
    if (moved.previous == kNone) {
      heads_[from].corner = moved.next;
    } else {
      corners_[moved.previous].next = moved.next;
    }
    if (moved.next != kNone) corners_[moved.next].previous = moved.previous;
    moved.vertex = to;
    LinkCorner(corner, to);
  }

  uint32_t vertex_count() const { return static_cast<uint32_t>(heads_.size()); }
  uint32_t edge_count() const { return static_cast<uint32_t>(half_edges_.size() / 2); }
  uint32_t face_count() const { return static_cast<uint32_t>(corners_.size() / 3); }
  uint32_t FirstHalfEdge(uint32_t vertex) const { return heads_[vertex].half_edge; }
  /// Number of edges.
  uint32_t Degree(uint32_t vertex) const { return heads_[vertex].degree; }
  uint32_t FirstCorner(uint32_t vertex) const { return heads_[vertex].corner; }
  const HalfEdge& half_edge(uint32_t index) const { return half_edges_[index]; }
  const Corner& corner(uint32_t index) const { return corners_[index]; }
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
  struct Heads {
    uint32_t half_edge;
    uint32_t corner;
    uint32_t degree;
  };
  void LinkHalfEdge(uint32_t half_edge, uint32_t vertex) {
    uint32_t first = heads_[vertex].half_edge;
    half_edges_[half_edge].next = first;
    half_edges_[half_edge].previous = kNone;
    if (first != kNone) half_edges_[first].previous = half_edge;
    heads_[vertex].half_edge = half_edge;
    ++heads_[vertex].degree;
  }
  void LinkCorner(uint32_t corner, uint32_t vertex) {
    uint32_t first = heads_[vertex].corner;
    corners_[corner].next = first;
    corners_[corner].previous = kNone;
    if (first != kNone) corners_[first].previous = corner;
    heads_[vertex].corner = corner;
  }

  std::vector<Heads> heads_;
  std::vector<HalfEdge> half_edges_;
  std::vector<Corner> corners_;
};

/// Throws Failure kCorrupt when a complex has more faces, or edges, than `mesh_faces` faces allow.
inline void CheckSize(const Complex& complex, uint64_t mesh_faces) {
  if (complex.face_count() > mesh_faces || complex.edge_count() > 3 * mesh_faces) {
    throw Failure(ErrorKind::kCorrupt, "more faces or edges coded than the table announces");
  }
}

/// Next and previous corner of the same face.
inline uint32_t NextCorner(uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
inline uint32_t PreviousCorner(uint32_t corner) {
  return corner % 3 == 0 ? corner + 2 : corner - 1;
}

}  // namespace folprom
