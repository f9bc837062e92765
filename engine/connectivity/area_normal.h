// Which way the faces around a vertex look.
#pragma once

#include <span>

#include "engine/connectivity/complex.h"
#include "engine/geometry/local_frame.h"

namespace folprom {

/// Sum of the normals of the faces around the vertex, each twice as long as its face is large.
inline Vector3 AreaNormal(const Complex& complex, std::span<const Int3> positions,
                          uint32_t vertex) {
  const Int3& centre = positions[vertex];
  Vector3 normal{0, 0, 0};
  for (const uint32_t corner : complex.Corners(vertex)) {
    const auto [a, b] = complex.Opposite(corner);
    const Vector3 cross = Cross(Difference(positions[a], centre), Difference(positions[b], centre));
    for (size_t i = 0; i < 3; ++i) normal[i] = normal[i] + cross[i];
  }
  return normal;
}

}  // namespace folprom
