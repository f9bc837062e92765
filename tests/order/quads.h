// Faces of four corners.
#pragma once

#include <cstdint>
#include <vector>

namespace folprom::support {

using Faces = std::vector<std::vector<int64_t>>;

/// Of a grid of side x side vertices, row by row.
inline Faces Quads(int64_t side) {
  Faces faces;
  for (int64_t y = 0; y + 1 < side; ++y) {
    for (int64_t x = 0; x + 1 < side; ++x) {
      const int64_t a = y * side + x;
      faces.push_back({a, a + 1, a + side + 1, a + side});
    }
  }
  return faces;
}

}  // namespace folprom::support
