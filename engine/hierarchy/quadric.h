// A quadric: weighted squared distances from planes, as one quadratic form around a vertex of its
// own, so that floats hold it.
#pragma once

#include "engine/geometry/local_frame.h"

namespace folprom {

/// Sum over planes of weight * (n . p + d)^2, p relative to the vertex, and the sum of the weights.
struct Quadric {
  float xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  float x = 0, y = 0, z = 0;
  float constant = 0;
  float weight = 0;

  struct Offset {
    float x, y, z;
  };

  /// A plane through the vertex; normal: unit.
  void AddPlane(const Vector3& normal, double plane_weight) {
    const auto term = [&](size_t i, size_t j) {
      return static_cast<float>(plane_weight * normal[i] * normal[j]);
    };
    xx += term(0, 0);
    xy += term(0, 1);
    xz += term(0, 2);
    yy += term(1, 1);
    yz += term(1, 2);
    zz += term(2, 2);
    weight += static_cast<float>(plane_weight);
  }
  /// Of another vertex, which lies at `from` relative to this one.
  void Add(const Quadric& other, const Offset& from) {
    // What lies at p here lies at p - from there.
    const Offset bend = other.Bend(from);
    x += other.x - bend.x;
    y += other.y - bend.y;
    z += other.z - bend.z;
    constant += other.At({-from.x, -from.y, -from.z});
    xx += other.xx;
    xy += other.xy;
    xz += other.xz;
    yy += other.yy;
    yz += other.yz;
    zz += other.zz;
    weight += other.weight;
  }
  float At(const Offset& p) const {
    const Offset bend = Bend(p);
    const float value = p.x * (bend.x + 2 * x) + p.y * (bend.y + 2 * y) +
                        p.z * (bend.z + 2 * z) + constant;
    return value > 0 ? value : 0;
  }

 private:
  Offset Bend(const Offset& p) const {
    return {xx * p.x + xy * p.y + xz * p.z, xy * p.x + yy * p.y + yz * p.z,
            xz * p.x + yz * p.y + zz * p.z};
  }
};

}  // namespace folprom
