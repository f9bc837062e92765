#include "engine/geometry/ring_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "engine/entropy/least_squares.h"

namespace folprom {
namespace {

/// The ways to the neighbours along the tangent plane, and their heights over it.
struct LocalPoint {
  Pair uv;
  double height;
};

void FitBend(RingShape* shape, std::span<const LocalPoint> local) {
  // Least squares for (uu, uv, vv) in units of the spacing, with a ridge that keeps thin rings
  // tame. The sums are those of the products of a row of the system: uu, uv, vv, height.
  const double unit = 1 / shape->spacing;
  Pair first = Both(0), first_rest = Both(0), second = Both(0), heights = Both(0);
  double third = 0;
  for (const LocalPoint& p : local) {
    const Pair scaled = p.uv * Both(unit), squares = scaled * scaled;
    const double h = p.height * unit, across = scaled[0] * scaled[1];
    const Pair row{squares[0], across}, rest{squares[1], h};
    first = first + Both(row[0]) * row;
    first_rest = first_rest + Both(row[0]) * rest;
    second = second + Both(across) * Pair{across, rest[0]};
    heights = heights + Pair{across, rest[0]} * Both(h);
    third = third + rest[0] * rest[0];
  }
  constexpr double kRidge = 0.1;
  SolvePositive<3>({{{first[0] + kRidge, first[1], first_rest[0], first_rest[1]},
                     {first[1], second[0] + kRidge, second[1], heights[0]},
                     {first_rest[0], second[1], third + kRidge, heights[1]}}},
                   &shape->bend);
  for (double& value : shape->bend) value = value * unit;
}

Vector3 Divided(Pair xy, double z, double by) {
  const Pair parts = xy / Both(by);
  return {parts[0], parts[1], z / by};
}

/// Directions and reach.
void WeighSpokes(std::span<const RingSpoke> ring, RingShape* shape) {
  const Pair count = Both(static_cast<double>(ring.size()));
  Pair direction = Both(0), reach = Both(0), both_z = Both(0);
  for (const RingSpoke& spoke : ring) {
    const double distance = spoke.z_length[1];
    Pair weights =
        Pair{shape->spacing, distance} / Pair{distance, shape->spacing} / count;  // near, far
    if (!(distance > 0)) weights[0] = 0;
    direction = direction + Both(weights[0]) * spoke.xy;
    reach = reach + Both(weights[1]) * spoke.xy;
    both_z = both_z + weights * Both(spoke.z_length[0]);
  }
  shape->direction = {direction[0], direction[1], both_z[0]};
  shape->reach = {reach[0], reach[1], both_z[1]};
}

void MeasureCovariance(std::span<const RingSpoke> ring, RingShape* shape) {
  const Pair count = Both(static_cast<double>(ring.size()));
  const Pair mean_xy{shape->mean[0], shape->mean[1]};
  Pair xx_xy = Both(0), xz_yy = Both(0), yz_zz = Both(0);
  for (const RingSpoke& spoke : ring) {
    const Pair xy = spoke.xy - mean_xy;
    const Pair z = Both(spoke.z_length[0] - shape->mean[2]);
    xx_xy = xx_xy + Both(xy[0]) * xy / count;
    xz_yy = xz_yy + xy * FirstSecond(z, xy) / count;
    yz_zz = yz_zz + SecondSecond(xy, z) * z / count;
  }
  shape->covariance = {xx_xy[0], xx_xy[1], xz_yy[0], xz_yy[1], yz_zz[0], yz_zz[1]};
}

/// The quadric over the tangent plane.
void MeasureBend(std::span<const RingSpoke> ring, RingShape* shape) {
  shape->tangent = TangentAxis(shape->normal);
  const Vector3 &normal = shape->normal, &tangent = shape->tangent;
  const Vector3 side = Cross(normal, tangent);
  const Pair u_x{tangent[0], side[0]}, u_y{tangent[1], side[1]}, u_z{tangent[2], side[2]};
  std::array<LocalPoint, RingShape::kMostSpokes> local;
  for (size_t n = 0; n < ring.size(); ++n) {
    const RingSpoke& spoke = ring[n];
    const Pair z = Both(spoke.z_length[0]);
    local[n].uv = Both(spoke.xy[0]) * u_x + Both(spoke.xy[1]) * u_y + z * u_z;
    local[n].height = HeightOf(spoke, normal);
  }
  const std::span<const LocalPoint> points(local.data(), ring.size());
  FitBend(shape, points);
  double squares = 0;
  for (const LocalPoint& p : points) {
    const double left = p.height - shape->HeightAt(p.uv[0], p.uv[1]);
    squares = squares + left * left;
  }
  shape->fit_error = std::sqrt(squares / static_cast<double>(ring.size()));
}

}  // namespace

double RingShape::MeetQuadric(const Vector3& offset) const {
  size_t k = dominant, i = (k + 1) % 3, j = (k + 2) % 3;
  Vector3 side = Cross(normal, tangent);
  double level = -(normal[i] * offset[i] + normal[j] * offset[j]) / normal[k];
  double along = level;
  for (int step = 0; step < 2; ++step) {
    Vector3 d = offset;
    d[k] = along;
    along = level + HeightAt(Dot(d, tangent), Dot(d, side)) / normal[k];
  }
  double most = 2 * spacing;
  return std::clamp(along, level - most, level + most);
}

Vector3 NormalOrAny(const Vector3& normal, std::span<const RingSpoke> ring, const Vector3& mean) {
  if (Dot(normal, normal) > 0) return normal;
  // Without faces: across the two that span most of those which follow each other in the list.
  Vector3 best{0, 0, 0};
  double most = 0;
  for (size_t i = 0; i + 1 < ring.size(); ++i) {
    Vector3 cross = Cross(ring[i].way(), ring[i + 1].way());
    double size = Dot(cross, cross);
    if (size > most) {
      most = size;
      best = cross;
    }
  }
  if (most > 0) return best;
  Vector3 cross = Cross(mean, {0, 0, 1});
  return Dot(cross, cross) > 0 ? Cross(cross, mean) : Vector3{1, 0, 0};
}

RingPlane MeasurePlane(std::span<const RingSpoke> ring, const Vector3& normal, double scale) {
  RingPlane plane;
  plane.count = static_cast<uint32_t>(ring.size());
  if (ring.empty()) {
    plane.spacing = plane.height_range = scale > 0 ? scale : 1;
    return plane;
  }
  ring = ring.first(std::min(ring.size(), RingShape::kMostSpokes));
  Pair xy = Both(0), z_length = Both(0);
  for (const RingSpoke& spoke : ring) {
    xy = xy + spoke.xy;
    z_length = z_length + spoke.z_length;
  }
  const auto count = static_cast<double>(ring.size());
  plane.mean = Divided(xy, z_length[0], count);
  plane.spacing = z_length[1] / count;
  if (!(plane.spacing > 0)) plane.spacing = 1;
  plane.normal = NormalOrAny(normal, ring, plane.mean);
  const double length = std::sqrt(Dot(plane.normal, plane.normal));
  for (double& value : plane.normal) value = value / length;
  for (uint32_t i = 0; i < 3; ++i) {
    const double size = plane.normal[i] * plane.normal[i];
    if (i == 0 || size > plane.normal[plane.dominant] * plane.normal[plane.dominant]) {
      plane.dominant = i;
    }
  }
  plane.height_range = HeightRange(ring, plane.normal);
  return plane;
}

double HeightRange(std::span<const RingSpoke> ring, const Vector3& axis) {
  double low = 0, high = 0;
  for (const RingSpoke& spoke : ring) {
    const double height = HeightOf(spoke, axis);
    low = std::min(low, height);
    high = std::max(high, height);
  }
  return high - low;
}

RingShape MeasureRing(std::span<const RingSpoke> ring, const FanSums& fan, double scale) {
  RingShape shape;
  static_cast<RingPlane&>(shape) = MeasurePlane(ring, fan.normal(), scale);
  if (ring.empty()) {
    const double share = shape.spacing * shape.spacing / 3;
    shape.covariance = {share, 0, 0, share, 0, share};
    shape.fit_error = shape.spacing;
    return shape;
  }
  ring = ring.first(std::min(ring.size(), RingShape::kMostSpokes));
  std::copy(ring.begin(), ring.end(), shape.spokes.begin());
  const double area = fan.area_rim[0], rim = fan.area_rim[1];
  shape.area_centre = area > 0 ? Divided(fan.area_centre_xy, fan.centre_z[0], area) : shape.mean;
  shape.rim_centre = rim > 0 ? Divided(fan.rim_centre_xy, fan.centre_z[1], rim) : shape.mean;
  WeighSpokes(ring, &shape);
  MeasureCovariance(ring, &shape);
  MeasureBend(ring, &shape);
  return shape;
}

}  // namespace folprom
