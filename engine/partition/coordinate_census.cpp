#include "engine/partition/coordinate_census.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <vector>

#include "engine/partition/vertex_blocks.h"

namespace folprom {
namespace {

void Count(size_t axis, double x, bool is_float, CoordinateCensus* census) {
  if (!IsTame(x)) return;
  Bounds& box = census->bounds;
  box.lo[axis] = std::min(box.lo[axis], x);
  box.hi[axis] = std::max(box.hi[axis], x);
  ++census->coordinates;
  ++census->decimals[static_cast<size_t>(DecimalsOf(x, is_float))];
  const int32_t bits = x == 0 ? CoordinateCensus::kLeastBits : FractionBitsOf(x);
  ++census->bits[static_cast<size_t>(bits - CoordinateCensus::kLeastBits)];
}

/// Holds nothing: every coordinate extends it.
Bounds Nothing() {
  constexpr double kMost = ExactStep::kLargest;
  return {{kMost, kMost, kMost}, {-kMost, -kMost, -kMost}};
}

void Add(const CoordinateCensus& part, CoordinateCensus* census) {
  for (size_t axis = 0; axis < 3; ++axis) {
    census->bounds.lo[axis] = std::min(census->bounds.lo[axis], part.bounds.lo[axis]);
    census->bounds.hi[axis] = std::max(census->bounds.hi[axis], part.bounds.hi[axis]);
  }
  census->coordinates += part.coordinates;
  for (size_t i = 0; i < part.decimals.size(); ++i) census->decimals[i] += part.decimals[i];
  for (size_t i = 0; i < part.bits.size(); ++i) census->bits[i] += part.bits[i];
}

}  // namespace

CoordinateCensus TakeCensus(const io::MeshSource& source, bool is_float, parallel::Runner& runner,
                            parallel::Progress& progress) {
  progress.StartStage("bounds", source.vertex_count(), "vertices");
  std::mutex mutex;
  CoordinateCensus census;
  census.bounds = Nothing();
  const auto take = [&](size_t, const std::vector<double>& xyz) {
    CoordinateCensus part;
    part.bounds = Nothing();
    for (size_t i = 0; i < xyz.size(); ++i) Count(i % 3, xyz[i], is_float, &part);
    const std::lock_guard lock(mutex);
    Add(part, &census);
  };
  partition::ForEachVertexBlock(source, runner, progress, take);
  for (size_t axis = 0; axis < 3; ++axis) {
    double &lo = census.bounds.lo[axis], &hi = census.bounds.hi[axis];
    if (lo > hi) lo = hi = 0;  // nothing tame on this axis
    // -0 and 0 compare equal, so which of them survives could depend on the order of the blocks.
    lo += 0.0;
    hi += 0.0;
  }
  return census;
}

bool HasRests(const io::MeshSource& source, const Lattice& lattice, parallel::Runner& runner,
              parallel::Progress& progress) {
  progress.StartStage("lattice", source.vertex_count(), "vertices");
  std::atomic<bool> found = false;
  const auto look = [&](size_t, const std::vector<double>& xyz) {
    for (size_t i = 0; i < xyz.size() && !found; ++i) {
      const size_t axis = i % 3;
      if (lattice.exact->Split(axis, lattice.extent[axis], xyz[i]).rest.digits > 0) found = true;
    }
  };
  partition::ForEachVertexBlock(source, runner, progress, look);
  return found;
}

}  // namespace folprom
