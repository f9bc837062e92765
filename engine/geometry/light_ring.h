// What light models look at of the one-ring of a vertex: along the two axes of the lattice that lie
// nearest to the surface, and across it.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/geometry/ring_shape.h"
#include "engine/mesh/types.h"

namespace folprom {

/// Lattice units, relative to the vertex. Exact to repeat, as RingShape is.
struct LightRing {
  uint32_t count = 0;    ///< neighbours
  bool is_open = false;  ///< as in RingShape
  double spacing = 1;    ///< mean distance of the neighbours
  Vector3 mean{0, 0, 0};
  Vector3 direction{0, 0, 0};  ///< mean of the unit vectors to the neighbours, times the spacing
  std::array<uint32_t, 3> axes{0, 1, 2};  ///< two along the surface, the one across
  std::array<double, 2> variance{};       ///< of the neighbours around their mean, along
  double covariance = 0;
  std::array<double, 2> slope{};  ///< of the tangent plane, across over along
  std::array<double, 3> bend{};   ///< over the plane: bend . (x x, x y, y y) of the offsets along
  double miss = 0;                ///< root mean square of what plane and bend leave, across
  double range = 0;               ///< of the neighbours and the vertex over the plane, across
  std::span<const RingSpoke> spokes;  ///< those that are looked at

  /// Where the surface lies across, given the offset along.
  double Across(double x, double y) const;
};

/// ring stays what the result looks at. normal, scale: as in MeasurePlane.
LightRing MeasureLightRing(std::span<const RingSpoke> ring, const Vector3& normal, double scale);

}  // namespace folprom
