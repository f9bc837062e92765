#include "engine/geometry/light_ring.h"

#include <algorithm>
#include <cmath>

#include "engine/entropy/least_squares.h"

namespace folprom {
namespace {

/// Sums over the spokes.
struct Sums {
  double xx = 0, xy = 0, yy = 0;
  std::array<std::array<double, 4>, 3> rows{};  ///< products of xx, xy, yy with them and r
  double rr = 0;                                ///< r: what lies over the plane

  /// In spacings.
  void AddToBend(double x, double y, double r) {
    const double a = x * x, b = x * y, c = y * y;
    rows[0][0] = rows[0][0] + a * a;
    rows[0][1] = rows[0][1] + a * b;
    rows[0][2] = rows[0][2] + a * c;
    rows[0][3] = rows[0][3] + a * r;
    rows[1][2] = rows[1][2] + b * c;
    rows[1][3] = rows[1][3] + b * r;
    rows[2][2] = rows[2][2] + c * c;
    rows[2][3] = rows[2][3] + c * r;
    rr = rr + r * r;
  }
};

/// Least squares with a ridge that keeps thin rings tame; all in spacings but for the results.
void FitBend(Sums* sums, LightRing* ring) {
  constexpr double kRidge = 0.1;
  auto& rows = sums->rows;
  const std::array<double, 3> heights{rows[0][3], rows[1][3], rows[2][3]};
  rows[1][0] = rows[0][1];
  rows[2][0] = rows[1][1] = rows[0][2];
  rows[2][1] = rows[1][2];
  for (size_t i = 0; i < 3; ++i) rows[i][i] = rows[i][i] + kRidge;
  std::array<double, 3> bend{};
  SolvePositive<3>(rows, &bend);
  double left = sums->rr;
  for (size_t i = 0; i < 3; ++i) left = left - bend[i] * (heights[i] + kRidge * bend[i]);
  ring->miss = ring->spacing * std::sqrt(std::max(left, 0.0) / ring->count);
  for (size_t i = 0; i < 3; ++i) ring->bend[i] = bend[i] / ring->spacing;
}

LightRing WithoutNeighbours(double scale) {
  LightRing ring;
  if (scale > 0) ring.spacing = scale;
  ring.variance.fill(ring.spacing * ring.spacing / 3);
  ring.miss = ring.range = ring.spacing;
  return ring;
}

}  // namespace

double LightRing::Across(double x, double y) const {
  const double level = -(slope[0] * x + slope[1] * y), most = 2 * spacing;
  const double bent = bend[0] * x * x + bend[1] * x * y + bend[2] * y * y;
  return level + std::clamp(bent, -most, most);
}

LightRing MeasureLightRing(std::span<const RingSpoke> spokes, const Vector3& normal, double scale) {
  if (spokes.empty()) return WithoutNeighbours(scale);
  LightRing ring;
  ring.count = static_cast<uint32_t>(spokes.size());
  ring.spokes = spokes = spokes.first(std::min(spokes.size(), RingShape::kMostSpokes));
  const double per_spoke = 1 / static_cast<double>(spokes.size());
  Pair xy = Both(0), z_length = Both(0), direction_xy = Both(0);
  double direction_z = 0;
  for (const RingSpoke& spoke : spokes) {
    const double distance = spoke.z_length[1], weight = distance > 0 ? 1 / distance : 0;
    xy = xy + spoke.xy;
    z_length = z_length + spoke.z_length;
    direction_xy = direction_xy + Both(weight) * spoke.xy;
    direction_z = direction_z + weight * spoke.z_length[0];
  }
  ring.mean = {xy[0] * per_spoke, xy[1] * per_spoke, z_length[0] * per_spoke};
  if (z_length[1] > 0) ring.spacing = z_length[1] * per_spoke;
  const double share = ring.spacing * per_spoke;
  ring.direction = {direction_xy[0] * share, direction_xy[1] * share, direction_z * share};
  const Vector3 across = NormalOrAny(normal, spokes, ring.mean);
  uint32_t dominant = 0;
  for (uint32_t i = 1; i < 3; ++i) {
    if (std::fabs(across[i]) > std::fabs(across[dominant])) dominant = i;
  }
  const uint32_t first = (dominant + 1) % 3, second = (dominant + 2) % 3;
  ring.axes = {first, second, dominant};
  ring.slope = {across[first] / across[dominant], across[second] / across[dominant]};
  const double unit = 1 / ring.spacing;
  double low = 0, high = 0;
  Sums sums;
  for (const RingSpoke& spoke : spokes) {
    const Vector3 way = spoke.way();
    const double x = way[first], y = way[second];
    const double over = way[dominant] + (ring.slope[0] * x + ring.slope[1] * y);
    low = std::min(low, over);
    high = std::max(high, over);
    sums.xx = sums.xx + x * x;
    sums.xy = sums.xy + x * y;
    sums.yy = sums.yy + y * y;
    sums.AddToBend(x * unit, y * unit, over * unit);
  }
  ring.range = high - low;
  const double x = ring.mean[first], y = ring.mean[second];
  ring.variance = {sums.xx * per_spoke - x * x, sums.yy * per_spoke - y * y};
  ring.covariance = sums.xy * per_spoke - x * y;
  FitBend(&sums, &ring);
  return ring;
}

}  // namespace folprom
