// Points in double and the few operations that distances need.
#pragma once

#include <array>
#include <cmath>

namespace folprom::measure {

using Vector3 = std::array<double, 3>;

inline Vector3 Difference(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline double Dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vector3 Cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double Length(const Vector3& a) { return std::sqrt(Dot(a, a)); }

/// origin + s a + t b
inline Vector3 Combination(const Vector3& origin, double s, const Vector3& a, double t,
                           const Vector3& b) {
  return {origin[0] + s * a[0] + t * b[0], origin[1] + s * a[1] + t * b[1],
          origin[2] + s * a[2] + t * b[2]};
}

}  // namespace folprom::measure
