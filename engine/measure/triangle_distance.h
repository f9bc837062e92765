// Squared distance of a point from a triangle, safe for slivers and triangles without area.
#pragma once

#include <algorithm>

#include "engine/measure/vector3.h"

namespace folprom::measure {

inline double SquaredDistanceToSegment(const Vector3& point, const Vector3& a, const Vector3& b) {
  const Vector3 along = Difference(b, a);
  const Vector3 from_a = Difference(point, a);
  const double length2 = Dot(along, along);
  const double t = length2 > 0 ? std::clamp(Dot(from_a, along) / length2, 0.0, 1.0) : 0;
  const Vector3 away = Difference(from_a, {t * along[0], t * along[1], t * along[2]});
  return Dot(away, away);
}

inline double SquaredDistanceToTriangle(const Vector3& point, const Vector3& a, const Vector3& b,
                                        const Vector3& c) {
  // Below this sine of the angle at a the normal is rounding noise; the edges say all there is.
  constexpr double kLeastSine2 = 1e-24;
  const Vector3 ab = Difference(b, a);
  const Vector3 ac = Difference(c, a);
  const Vector3 normal = Cross(ab, ac);
  const double normal2 = Dot(normal, normal);
  if (normal2 > kLeastSine2 * Dot(ab, ab) * Dot(ac, ac)) {
    const Vector3 from_a = Difference(point, a);
    const double s = Dot(Cross(from_a, ac), normal);
    const double t = Dot(Cross(ab, from_a), normal);
    if (s >= 0 && t >= 0 && s + t <= normal2) {
      const double height = Dot(from_a, normal);
      return height * height / normal2;
    }
  }
  return std::min({SquaredDistanceToSegment(point, a, b), SquaredDistanceToSegment(point, b, c),
                   SquaredDistanceToSegment(point, c, a)});
}

}  // namespace folprom::measure
