// Vectors as the ray caster takes them.
#pragma once

#include <cmath>

namespace folprom::render {

struct Float3 {
  float x = 0, y = 0, z = 0;
};

inline Float3 operator+(const Float3& a, const Float3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Float3 operator-(const Float3& a, const Float3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Float3 operator*(float s, const Float3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline float Dot(const Float3& a, const Float3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Of length 1; (0, 0, 0) stays.
inline Float3 Normalized(const Float3& a) {
  const float length = std::sqrt(Dot(a, a));
  return length > 0 ? (1 / length) * a : a;
}

}  // namespace folprom::render
