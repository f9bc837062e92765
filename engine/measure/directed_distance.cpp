#include "engine/measure/directed_distance.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace folprom::measure {
namespace {

// Distances below this, in a box of diagonal 1, are rounding of the points themselves.
constexpr double kResolution = 1e-15;

struct Sums {
  double distance = 0;
  double squared = 0;
  double max = 0;
};

Sums SumsOf(const std::vector<Vector3>& points, const NearestSurface& to) {
  Sums sums;
  uint32_t guess = 0;
  for (const Vector3& point : points) {
    const NearestSurface::Nearest nearest = to.From(point, guess);
    guess = nearest.element;
    const double distance = nearest.distance < kResolution ? 0 : nearest.distance;
    sums.distance += distance;
    sums.squared += distance * distance;
    sums.max = std::max(sums.max, distance);
  }
  return sums;
}

// The larger of `known` and the largest distance. Points that lie nearer than that to the element
// found last need no search.
double MaxOf(const std::vector<Vector3>& points, const NearestSurface& to, double known) {
  double max = known;
  uint32_t guess = 0;
  for (const Vector3& point : points) {
    if (to.DistanceOf(guess, point) <= max) continue;
    const NearestSurface::Nearest nearest = to.From(point, guess);
    guess = nearest.element;
    if (nearest.distance >= kResolution) max = std::max(max, nearest.distance);
  }
  return max;
}

}  // namespace

DistanceStatistics DirectedDistance(const SurfaceSamples& from, const NearestSurface& to,
                                    const char* stage, parallel::Runner& runner,
                                    parallel::Progress& progress) {
  progress.StartStage(stage, from.area_blocks() + from.outline_blocks());
  std::vector<Sums> blocks(from.area_blocks());
  runner.ForEach(blocks.size(), [&](size_t block) {
    std::vector<Vector3> points;
    from.FillAreaBlock(block, &points);
    blocks[block] = SumsOf(points, to);
    progress.Advance(1);
  });
  Sums total;
  for (const Sums& sums : blocks) {
    total.distance += sums.distance;
    total.squared += sums.squared;
    total.max = std::max(total.max, sums.max);
  }

  std::vector<double> maxima(from.outline_blocks());
  runner.ForEach(maxima.size(), [&](size_t block) {
    std::vector<Vector3> points;
    from.FillOutlineBlock(block, &points);
    maxima[block] = MaxOf(points, to, total.max);
    progress.Advance(1);
  });
  for (const double max : maxima) total.max = std::max(total.max, max);

  const auto count = static_cast<double>(from.area_count());
  return {total.distance / count, std::sqrt(total.squared / count), total.max};
}

}  // namespace folprom::measure
