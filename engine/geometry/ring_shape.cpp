#include "engine/geometry/ring_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/entropy/least_squares.h"

namespace folprom {
namespace {

void FitBend(RingShape* shape, std::span<const Vector3> local) {
  // Least squares for (uu, uv, vv) in units of the spacing, with a ridge that keeps thin rings
  // tame.
  std::array<std::array<double, 4>, 3> a{};
  double unit = shape->spacing > 0 ? 1 / shape->spacing : 0;
  for (const Vector3& p : local) {
    double u = p[0] * unit, v = p[1] * unit, h = p[2] * unit;
    double row[3] = {u * u, u * v, v * v};
    for (size_t i = 0; i < 3; ++i) {
      for (size_t j = 0; j < 3; ++j) a[i][j] = a[i][j] + row[i] * row[j];
      a[i][3] = a[i][3] + row[i] * h;
    }
  }
  constexpr double kRidge = 0.1;
  for (size_t i = 0; i < 3; ++i) a[i][i] = a[i][i] + kRidge;
  SolvePositive(a, &shape->bend);
  for (double& value : shape->bend) value = value * unit;
}

Vector3 AnyNormal(std::span<const Vector3> ring, const Vector3& mean) {
  // Without faces: across the two that span most of those which follow each other in the list.
  Vector3 best{0, 0, 0};
  double most = 0;
  for (size_t i = 0; i + 1 < ring.size(); ++i) {
    Vector3 cross = Cross(ring[i], ring[i + 1]);
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

}  // namespace

void FanSums::AddFace(const Vector3& a, const Vector3& b) {
  Vector3 cross = Cross(a, b);
  double size = std::sqrt(Dot(cross, cross));
  Vector3 side{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  double length = std::sqrt(Dot(side, side));
  area = area + size;
  rim = rim + length;
  for (size_t i = 0; i < 3; ++i) {
    normal[i] = normal[i] + cross[i];
    double sum = a[i] + b[i];
    area_centre[i] = area_centre[i] + size * sum / 3;
    rim_centre[i] = rim_centre[i] + length * sum / 2;
  }
}

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

RingShape MeasureRing(const Int3& vertex, std::span<const Int3> ring, const FanSums& fan,
                      double scale) {
  RingShape shape;
  shape.count = static_cast<uint32_t>(ring.size());
  std::array<Vector3, 32>& around = shape.around;
  size_t used = std::min(ring.size(), around.size());
  double distances = 0;
  for (size_t n = 0; n < used; ++n) {
    around[n] = Difference(ring[n], vertex);
    distances = distances + std::sqrt(Dot(around[n], around[n]));
    for (size_t i = 0; i < 3; ++i) shape.mean[i] = shape.mean[i] + around[n][i];
  }
  if (used == 0) {
    if (!(scale > 0)) scale = 1;
    shape.spacing = scale;
    double share = scale * scale / 3;
    shape.covariance = {share, 0, 0, share, 0, share};
    shape.fit_error = shape.height_range = scale;
    return shape;
  }
  double count = static_cast<double>(used);
  shape.spacing = distances / count;
  if (!(shape.spacing > 0)) shape.spacing = 1;
  for (size_t n = 0; n < used; ++n) {
    double distance = std::sqrt(Dot(around[n], around[n]));
    double near = distance > 0 ? shape.spacing / distance / count : 0;
    double far = distance / shape.spacing / count;
    for (size_t i = 0; i < 3; ++i) {
      shape.direction[i] = shape.direction[i] + near * around[n][i];
      shape.reach[i] = shape.reach[i] + far * around[n][i];
    }
  }
  for (double& value : shape.mean) value = value / count;
  for (size_t i = 0; i < 3; ++i) {
    shape.area_centre[i] = fan.area > 0 ? fan.area_centre[i] / fan.area : shape.mean[i];
    shape.rim_centre[i] = fan.rim > 0 ? fan.rim_centre[i] / fan.rim : shape.mean[i];
  }
  for (size_t n = 0; n < used; ++n) {
    size_t k = 0;
    for (size_t i = 0; i < 3; ++i) {
      for (size_t j = i; j < 3; ++j) {
        shape.covariance[k] = shape.covariance[k] + (around[n][i] - shape.mean[i]) *
                                                        (around[n][j] - shape.mean[j]) / count;
        ++k;
      }
    }
  }
  std::span<const Vector3> near(around.data(), used);
  shape.normal = Dot(fan.normal, fan.normal) > 0 ? fan.normal : AnyNormal(near, shape.mean);
  double length = std::sqrt(Dot(shape.normal, shape.normal));
  for (double& value : shape.normal) value = value / length;
  for (uint32_t i = 0; i < 3; ++i) {
    const double size = shape.normal[i] * shape.normal[i];
    if (i == 0 || size > shape.normal[shape.dominant] * shape.normal[shape.dominant]) {
      shape.dominant = i;
    }
  }
  const Vector3 tangent = TangentAxis(shape.normal);
  shape.tangent = tangent;
  Vector3 side = Cross(shape.normal, tangent);
  double low = 0, high = 0;
  std::array<Vector3, 32> local;
  for (size_t n = 0; n < used; ++n) {
    Vector3 d = around[n];
    local[n] = {Dot(d, tangent), Dot(d, side), Dot(d, shape.normal)};
    low = std::min(low, local[n][2]);
    high = std::max(high, local[n][2]);
  }
  shape.height_range = high - low;
  near = std::span<const Vector3>(local.data(), used);
  FitBend(&shape, near);
  double squares = 0;
  for (const Vector3& p : near) {
    double left = p[2] - shape.HeightAt(p[0], p[1]);
    squares = squares + left * left;
  }
  shape.fit_error = std::sqrt(squares / count);
  return shape;
}

}  // namespace folprom
