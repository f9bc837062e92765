// A cell of cylindrical (or Cartesian) coordinates: where a vertex must lie, and its halving
// (section 2.4).
#pragma once

#include <cmath>
#include <cstdint>

#include "engine/entropy/fixed_math.h"
#include "engine/geometry/local_frame.h"
#include "engine/mesh/types.h"

namespace folprom {

/// Point in a local frame. theta in [0, 2 pi). In a Cartesian frame rho is x and theta is y.
struct CylinderPoint {
  double rho = 0;
  double theta = 0;
  double z = 0;
};

inline CylinderPoint ToCylinder(const LocalFrame& frame, const Int3& point) {
  Vector3 d = Difference(point, frame.origin);
  double u = Dot(d, frame.x), v = Dot(d, frame.y()), w = Dot(d, frame.z);
  if (frame.cartesian) return {u, v, w};
  return {std::sqrt(u * u + v * v), Angle(u, v), w};
}

/// Centre and full widths. The vertex lies inside.
struct CylinderCell {
  LocalFrame frame;
  CylinderPoint centre;
  CylinderPoint width;

  /// Centre on the working lattice, clamped to [0, extent].
  Int3 Position(const Int3& extent) const {
    double u = centre.rho, v = centre.theta;
    if (!frame.cartesian) {
      double sine, cosine;
      SinCos(centre.theta, &sine, &cosine);
      u = centre.rho * cosine;
      v = centre.rho * sine;
    }
    Vector3 y = frame.y();
    auto round = [&](int32_t origin, size_t axis, int32_t limit) {
      double value = static_cast<double>(origin) + u * frame.x[axis] + v * y[axis] +
                     centre.z * frame.z[axis] + 0.5;
      if (!(value > 0)) return int32_t{0};
      if (value >= static_cast<double>(limit)) return limit;
      return static_cast<int32_t>(value);
    };
    return {round(frame.origin.x, 0, extent.x), round(frame.origin.y, 1, extent.y),
            round(frame.origin.z, 2, extent.z)};
  }

  /// Half widths as lengths: radial (with the sagitta of the arc), along the arc, along the axis.
  Vector3 HalfLengths() const {
    if (frame.cartesian) return {width.rho / 2, width.theta / 2, width.z / 2};
    double reach = centre.rho + width.rho / 2;
    return {width.rho / 2 + reach * width.theta * width.theta / 8, reach * width.theta / 2,
            width.z / 2};
  }

  /// Bound on the distance from the centre per axis, the largest of the three axes.
  double AxisBound() const {
    double sine = 0, cosine = 1;
    if (!frame.cartesian) SinCos(centre.theta, &sine, &cosine);
    Vector3 y = frame.y(), half = HalfLengths();
    double bound = 0;
    for (size_t i = 0; i < 3; ++i) {
      double radial = cosine * frame.x[i] + sine * y[i], along = cosine * y[i] - sine * frame.x[i];
      double sum = std::fabs(radial) * half[0] + std::fabs(along) * half[1] +
                   std::fabs(frame.z[i]) * half[2];
      if (sum > bound) bound = sum;
    }
    return bound;
  }

  enum Dimension { kRho = 0, kTheta = 1, kZ = 2 };
  /// The dimension to halve next: the longest in space.
  Dimension Longest() const {
    Vector3 half{width.rho / 2, HalfLengths()[1], width.z / 2};
    if (half[1] >= half[0] && half[1] >= half[2]) return kTheta;
    return half[0] >= half[2] ? kRho : kZ;
  }
  bool LiesInUpper(Dimension dimension, const CylinderPoint& point) const {
    switch (dimension) {
      case kRho:
        return point.rho >= centre.rho;
      case kZ:
        return point.z >= centre.z;
      default:
        break;
    }
    double turn = point.theta - centre.theta;
    if (frame.cartesian) return turn >= 0;
    if (turn > kPi) turn = turn - 2 * kPi;
    if (turn < -kPi) turn = turn + 2 * kPi;
    return turn >= 0;
  }
  void Halve(Dimension dimension, bool upper) {
    double& middle =
        dimension == kRho ? centre.rho : (dimension == kTheta ? centre.theta : centre.z);
    double& full = dimension == kRho ? width.rho : (dimension == kTheta ? width.theta : width.z);
    full = full / 2;
    middle = upper ? middle + full / 2 : middle - full / 2;
  }
};

}  // namespace folprom
