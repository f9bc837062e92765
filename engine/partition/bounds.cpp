// Pass 0: the bounding box.
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <string>

#include "engine/partition/block_pool.h"
#include "engine/partition/partition.h"
#include "engine/partition/resident_pages.h"

namespace folprom {
namespace {

// No memory limit is known here; small enough for any.
constexpr uint64_t kResidentBytes = uint64_t{32} << 20;

void ThrowAtFirstNotFinite(const io::MeshSource& source, uint64_t first_vertex,
                           const std::vector<double>& xyz) {
  for (size_t i = 0; i < xyz.size(); ++i) {
    if (std::isfinite(xyz[i])) continue;
    throw Failure(ErrorKind::kInput, source.path() + ": vertex " +
                                         std::to_string(first_vertex + i / 3) + ": coordinate " +
                                         "xyz"[i % 3] +
                                         " is not a finite number (--exact keeps it)");
  }
}

Bounds BoundsOf(const std::vector<double>& xyz, bool* finite) {
  Bounds box{{xyz[0], xyz[1], xyz[2]}, {xyz[0], xyz[1], xyz[2]}};
  double poison = 0;  // stays 0 as long as all are finite
  for (size_t i = 0; i < xyz.size(); i += 3) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const double value = xyz[i + axis];
      poison += value * 0;
      box.lo[axis] = std::min(box.lo[axis], value);
      box.hi[axis] = std::max(box.hi[axis], value);
    }
  }
  *finite = poison == 0;
  return box;
}

void Extend(Bounds* box, const Bounds& other) {
  if (box->empty()) {
    *box = other;
    return;
  }
  for (size_t axis = 0; axis < 3; ++axis) {
    box->lo[axis] = std::min(box->lo[axis], other.lo[axis]);
    box->hi[axis] = std::max(box->hi[axis], other.hi[axis]);
  }
}

}  // namespace

Bounds MeasureBounds(const io::MeshSource& source, parallel::Runner& runner,
                     parallel::Progress& progress) {
  progress.StartStage("bounds", source.vertex_count());
  partition::ResidentSource resident_source(source, kResidentBytes);
  partition::BlockPool<std::vector<double>> pool;
  std::mutex mutex;
  Bounds bounds;
  runner.ForEach(source.vertex_block_count(), [&](size_t block) {
    std::vector<double>& xyz = pool.Begin(block);
    source.ReadVertexBlock(block, &xyz).value();
    if (!xyz.empty()) {
      bool finite = true;
      const Bounds box = BoundsOf(xyz, &finite);
      if (!finite) ThrowAtFirstNotFinite(source, source.vertex_block_begin(block), xyz);
      const std::lock_guard lock(mutex);
      Extend(&bounds, box);
    }
    const uint64_t vertices = xyz.size() / 3;
    pool.End(block);
    resident_source.TouchedVertices(vertices);
    progress.Advance(vertices);
  });
  for (size_t axis = 0; axis < 3; ++axis) {
    // -0 and 0 compare equal, so which of them survives could depend on the order of the blocks.
    bounds.lo[axis] += 0.0;
    bounds.hi[axis] += 0.0;
  }
  return bounds;
}

}  // namespace folprom
