// The frame in which the children of a vertex set are placed (section 2.2).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/mesh/types.h"

namespace folprom {

using Vector3 = std::array<double, 3>;

inline double Dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector3 Cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Vector3 Difference(const Int3& a, const Int3& b) {
  return {static_cast<double>(a.x) - b.x, static_cast<double>(a.y) - b.y,
          static_cast<double>(a.z) - b.z};
}

/// Unit axes around an origin, and how points are told in it. y is z cross x.
struct LocalFrame {
  Int3 origin;
  bool cartesian = false;  ///< points are (x, y, z) instead of (rho, theta, z)
  Vector3 x{1, 0, 0};
  Vector3 z{0, 0, 1};
  Vector3 y() const { return Cross(z, x); }
};

/// Projection of the global axis that lies flattest in the plane across a unit normal on it; unit.
Vector3 TangentAxis(const Vector3& normal);

/// A frame with what the neighbours say about the surface there. Lattice units.
struct Neighbourhood {
  LocalFrame frame;
  double range_rho = 0;  ///< R_rho: largest distance of a neighbour from the axis
  double range_z = 0;    ///< R_z: spread of the heights, the vertex's own 0 included
  double mean_z = 0;     ///< of the neighbours: the sign tells hollow from hill
  double min_z = 0;      ///< lowest neighbour, at most 0

  /// A neighbour as seen along the axis.
  struct Direction {
    double x = 0, y = 0;  ///< unit vector in the tangent plane
    double rho = 0;       ///< distance from the axis
    double bend = 0;      ///< height over squared distance: the surface's curvature that way
  };
  std::vector<Direction> directions;

  /// What the surface is likely to be like in a direction: the neighbours weighed by how nearly
  /// they lie that way. All 0 without neighbours.
  struct Outlook {
    double rho = 0;
    double bend = 0;
  };
  Outlook Towards(double cosine, double sine) const;
};

/// Least-squares plane through the vertex and its neighbours. With fewer than three neighbours the
/// height range is the distance range; with none both are `scale` and the axes are the global ones.
/// Uses + - * / sqrt in a fixed order only: encoder and decoder get the same bits.
Neighbourhood MeasureNeighbourhood(const Int3& vertex, std::span<const Int3> neighbours,
                                   double scale);

}  // namespace folprom
