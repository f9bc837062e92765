// The plain values that every stage of the engine passes on.
#pragma once

#include <array>
#include <compare>
#include <cstdint>

namespace folprom {

/// A position on the working lattice (see lattice.h). Every coordinate lies in [0, 2^30).
struct Int3 {
  int32_t x = 0;
  int32_t y = 0;
  int32_t z = 0;
  auto operator<=>(const Int3&) const = default;
};

/// The coordinate along an axis: 0 x, 1 y, 2 z.
inline int32_t& At(Int3& p, uint32_t axis) { return axis == 0 ? p.x : (axis == 1 ? p.y : p.z); }
inline int32_t At(const Int3& p, uint32_t axis) {
  return axis == 0 ? p.x : (axis == 1 ? p.y : p.z);
}

/// A triangle as three vertex indices inside one subtree, in the order of its orientation.
using Face = std::array<uint32_t, 3>;

/// A vertex of the whole mesh: its subtree and its index inside it (order of the input file).
struct VertexRef {
  uint32_t subtree = 0;
  uint32_t local = 0;
  auto operator<=>(const VertexRef&) const = default;
};

/// A face whose vertices lie in two or three subtrees, with their positions so that normals need
/// no other chunk.
struct CrossFace {
  std::array<VertexRef, 3> vertex;
  std::array<Int3, 3> position;
};

}  // namespace folprom
