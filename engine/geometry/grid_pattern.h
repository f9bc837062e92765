// On regular grids splits repeat: what those around a vertex say of its next one.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/connectivity/complex.h"
#include "engine/geometry/local_frame.h"
#include "engine/mesh/types.h"

namespace folprom {

/// What is expected of the split of a vertex. Vectors are relative to it, lattice units.
struct GridHint {
  static constexpr uint32_t kMostSupport = 3;
  bool found = false;
  uint32_t support = 0;  ///< splits of neighbours that agree, at most kMostSupport
  Vector3 step{};        ///< to the new vertex, as neighbours did it
  Vector3 far{};         ///< to the neighbour beyond, about two steps away
  Vector3 across{};  ///< sum of the two neighbours that the vertex and the far one have in common
  /// How the last split of this kind parted the ring; 0: unknown.
  uint8_t kind = 0;
  uint32_t far_vertex = kNone;
  /// Neighbours, and what they are to the splits that agree.
  enum Mark : uint8_t { kOther = 0, kParent = 1, kChild = 2 };
  static constexpr uint32_t kMostNeighbours = 16;
  uint32_t count = 0;
  std::array<uint32_t, kMostNeighbours> neighbour;
  std::array<Mark, kMostNeighbours> mark;
};

/// Neighbours that made the same last step as a vertex did.
struct GridPeers {
  uint32_t leaves = 0;  ///< and are single vertices
  uint32_t split = 0;   ///< and have been split since
};

class GridPattern {
 public:
  /// The first vertex; others come by AddSplit in order of their numbers.
  void AddRoot();
  void AddSplit(uint32_t parent, uint32_t added);
  /// How the split added last parted the ring.
  void SetKind(uint8_t kind) { past_.back().kind = kind; }

  GridHint Expect(const Complex& complex, const std::vector<Int3>& positions,
                  uint32_t vertex) const;
  template <class IsLeaf>
  GridPeers PeersOf(const Complex& complex, const std::vector<Int3>& positions, uint32_t vertex,
                    IsLeaf is_leaf) const;

 private:
  /// A split is named by the vertex that it added.
  struct Past {
    uint32_t parent = kNone;
    uint32_t last = kNone, before = kNone;          ///< splits that the vertex took part in
    bool last_child = false, before_child = false;  ///< on the side of the vertex added
    uint8_t kind = 0;                               ///< of the split that added this vertex
  };
  Vector3 StepOf(const std::vector<Int3>& positions, uint32_t split) const {
    return Difference(positions[split], positions[past_[split].parent]);
  }

  std::vector<Past> past_;
};

inline bool IsNear(const Vector3& a, const Vector3& b, double squared) {
  const Vector3 d{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  return Dot(d, d) <= squared;
}

template <class IsLeaf>
GridPeers GridPattern::PeersOf(const Complex& complex, const std::vector<Int3>& positions,
                               uint32_t vertex, IsLeaf is_leaf) const {
  GridPeers peers;
  const uint32_t own = past_[vertex].last;
  if (own == kNone) return peers;
  const Vector3 step = StepOf(positions, own);
  const double near = 0.25 * Dot(step, step);
  const auto same = [&](uint32_t split) {
    return split != kNone && IsNear(StepOf(positions, split), step, near);
  };
  for (const auto& [other, half_edge] : complex.Spokes(vertex)) {
    if (is_leaf(other)) {
      peers.leaves += same(past_[other].last) ? 1 : 0;
    } else {
      peers.split += same(past_[other].before) ? 1 : 0;
    }
  }
  return peers;
}

}  // namespace folprom
