// What the one-ring of a vertex says about the surface and about a new vertex beside it.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/entropy/pairs.h"
#include "engine/geometry/local_frame.h"
#include "engine/mesh/types.h"

namespace folprom {

/// The way from a vertex to a neighbour, lattice units.
struct RingSpoke {
  Pair xy;
  Pair z_length;
  Vector3 way() const { return {xy[0], xy[1], z_length[0]}; }
};

/// A coordinate triple as two lanes and one.
struct LanePoint {
  explicit LanePoint(const Int3& p)
      : xy{static_cast<double>(p.x), static_cast<double>(p.y)}, z(static_cast<double>(p.z)) {}
  Pair xy;
  double z;
};

inline RingSpoke SpokeBetween(const LanePoint& from, const LanePoint& to) {
  const Pair xy = to.xy - from.xy;
  const double z = to.z - from.z;
  const Pair squares = xy * xy;
  return {xy, Pair{z, std::sqrt(squares[0] + squares[1] + z * z)}};
}

/// A face around a vertex: the ways to its two others, in the order of its orientation.
struct FanFace {
  FanFace() = default;
  FanFace(Pair a, Pair b, Pair ab_z) : a_xy(a), b_xy(b), z(ab_z) {
    const Pair ways = a_xy * Swapped(b_xy);
    cross_z = ways[0] - ways[1];
    // Its x is y z' - z y', its y is z x' - x z'.
    cross_xy =
        SecondFirst(a_xy, z) * SecondFirst(z, b_xy) - FirstFirst(z, a_xy) * SecondSecond(b_xy, z);
  }
  Pair a_xy, b_xy, z;
  Pair cross_xy;
  double cross_z;
};

/// Sums over the faces around a vertex, relative to it.
struct FanSums {
  Pair normal_xy{0, 0};  ///< area normals, twice the area long
  double normal_z = 0;
  Pair area_centre_xy{0, 0};  ///< centroids times twice the area
  Pair rim_centre_xy{0, 0};   ///< middles of the opposite edges times their length
  Pair centre_z{0, 0};        ///< of both
  Pair area_rim{0, 0};        ///< twice the area; length of the opposite edges

  Vector3 normal() const { return {normal_xy[0], normal_xy[1], normal_z}; }
  void AddFace(const FanFace& face) {
    normal_xy = normal_xy + face.cross_xy;
    normal_z = normal_z + face.cross_z;
    const Pair side_xy = face.b_xy - face.a_xy;
    const double side_z = face.z[1] - face.z[0];
    const Pair areas = face.cross_xy * face.cross_xy, sides = side_xy * side_xy;
    const Pair z_squares{face.cross_z * face.cross_z, side_z * side_z};
    const Pair sizes =
        SquareRoot(FirstFirst(areas, sides) + SecondSecond(areas, sides) + z_squares);
    area_rim = area_rim + sizes;
    const Pair sum = face.a_xy + face.b_xy;
    area_centre_xy = area_centre_xy + Both(sizes[0]) * sum / Both(3);
    rim_centre_xy = rim_centre_xy + Both(sizes[1]) * sum / Both(2);
    centre_z = centre_z + sizes * Both(face.z[0] + face.z[1]) / Pair{3, 2};
  }
};

/// Where the surface lies at a vertex, roughly. Lattice units, relative to the vertex. Exact to
/// repeat, as all here is: + - * / and sqrt in a fixed order.
struct RingPlane {
  uint32_t count = 0;       ///< neighbours
  double spacing = 0;       ///< mean distance of the neighbours
  Vector3 mean{0, 0, 0};    ///< of the neighbours
  Vector3 normal{0, 0, 1};  ///< unit
  double height_range = 0;  ///< of the neighbours and the vertex over the tangent plane
  uint32_t dominant = 2;    ///< axis nearest to the normal
};

struct RingShape : RingPlane {
  static constexpr size_t kMostSpokes = 32;
  bool is_open = false;  ///< fewer faces than neighbours: the surface ends there, or its subtree
  /// Those that are looked at.
  std::array<RingSpoke, kMostSpokes> spokes;
  Vector3 direction{0, 0, 0};    ///< mean of the unit vectors to the neighbours, times the spacing
  Vector3 area_centre{0, 0, 0};  ///< centroid of the faces; the mean where there is none
  Vector3 rim_centre{0, 0, 0};   ///< centroid of the edges opposite to the vertex; same
  Vector3 reach{0, 0, 0};  ///< mean of the neighbours weighted by their distance over the spacing
  std::array<double, 6> covariance{};  ///< xx xy xz yy yz zz of the neighbours around their mean
  Vector3 tangent{1, 0, 0};            ///< unit, in the tangent plane
  std::array<double, 3> bend{};        ///< height = bend . (u u, u v, v v)
  double fit_error = 0;  ///< root mean square of what the quadric leaves of the heights

  /// Height of the quadric over the tangent plane.
  double HeightAt(double u, double v) const {
    return bend[0] * u * u + bend[1] * u * v + bend[2] * v * v;
  }
  /// Offset along the dominant axis at which the quadric is met, given those along the two others.
  double MeetQuadric(const Vector3& offset) const;
};

inline double HeightOf(const RingSpoke& spoke, const Vector3& axis) {
  return spoke.xy[0] * axis[0] + spoke.xy[1] * axis[1] + spoke.z_length[0] * axis[2];
}
/// Of the neighbours and the vertex along an axis, in units of its length.
double HeightRange(std::span<const RingSpoke> ring, const Vector3& axis);

/// The normal if it is not 0, otherwise one of what neighbours span that follow each other in the
/// list; of any length above 0. mean: of a ring that is not empty.
Vector3 NormalOrAny(const Vector3& normal, std::span<const RingSpoke> ring, const Vector3& mean);

/// normal: sum over the faces; 0: there are none. scale: spacing to assume without neighbours.
RingPlane MeasurePlane(std::span<const RingSpoke> ring, const Vector3& normal, double scale);

RingShape MeasureRing(std::span<const RingSpoke> ring, const FanSums& fan, double scale);

}  // namespace folprom
