// Distance of a point from a mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/support/mesh.h"

namespace folprom::support {

/// The faces and vertices of a mesh in a uniform grid. Keeps a reference to the mesh.
class SurfaceDistance {
 public:
  /// At least one vertex.
  explicit SurfaceDistance(const Mesh& mesh);
  double To(const Point& point) const;

 private:
  using Cell = std::array<int64_t, 3>;
  Cell CellOf(const Point& point) const;
  size_t IndexOf(const Cell& cell) const;
  template <class Visit>
  void ForEachCellOf(const Triple& element, Visit visit) const;
  /// Looks at the cells `ring` steps away from the centre.
  void SearchRing(const Cell& centre, int64_t ring, const Point& point, double* nearest2) const;

  const Mesh& mesh_;
  std::vector<Triple> elements_;  ///< faces, then each vertex three times
  Point origin_{};
  double cell_ = 1;
  Cell size_{};
  std::vector<uint32_t> begin_, items_;
};

}  // namespace folprom::support
