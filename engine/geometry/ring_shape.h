// What the one-ring of a vertex says about the surface and about a new vertex beside it.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/geometry/local_frame.h"
#include "engine/mesh/types.h"

namespace folprom {

/// Sums over the faces around a vertex, relative to it.
struct FanSums {
  Vector3 normal{0, 0, 0};       ///< area normals, twice the area long
  Vector3 area_centre{0, 0, 0};  ///< centroids times twice the area
  Vector3 rim_centre{0, 0, 0};   ///< middles of the opposite edges times their length
  double area = 0;               ///< twice
  double rim = 0;

  void AddFace(const Vector3& a, const Vector3& b);
};

/// Lattice units, relative to the vertex. Exact to repeat: + - * / and sqrt in a fixed order.
struct RingShape {
  uint32_t count = 0;  ///< neighbours
  double spacing = 0;  ///< mean distance of the neighbours
  /// The neighbours, as many as are looked at.
  std::array<Vector3, 32> around;
  Vector3 mean{0, 0, 0};         ///< of the neighbours
  Vector3 direction{0, 0, 0};    ///< mean of the unit vectors to the neighbours, times the spacing
  Vector3 area_centre{0, 0, 0};  ///< centroid of the faces; the mean where there is none
  Vector3 rim_centre{0, 0, 0};   ///< centroid of the edges opposite to the vertex; same
  Vector3 reach{0, 0, 0};  ///< mean of the neighbours weighted by their distance over the spacing
  std::array<double, 6> covariance{};  ///< xx xy xz yy yz zz of the neighbours around their mean
  Vector3 normal{0, 0, 1};             ///< unit
  Vector3 tangent{1, 0, 0};            ///< unit, in the tangent plane
  std::array<double, 3> bend{};        ///< height = bend . (u u, u v, v v)
  double fit_error = 0;     ///< root mean square of what the quadric leaves of the heights
  double height_range = 0;  ///< of the neighbours and the vertex over the tangent plane
  uint32_t dominant = 2;    ///< axis nearest to the normal

  /// Height of the quadric over the tangent plane.
  double HeightAt(double u, double v) const {
    return bend[0] * u * u + bend[1] * u * v + bend[2] * v * v;
  }
  /// Offset along the dominant axis at which the quadric is met, given those along the two others.
  double MeetQuadric(const Vector3& offset) const;
};

/// scale: spacing to assume without neighbours.
RingShape MeasureRing(const Int3& vertex, std::span<const Int3> ring, const FanSums& fan,
                      double scale);

}  // namespace folprom
