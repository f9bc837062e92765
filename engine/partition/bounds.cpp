// Pass 0: the bounding box.
#include <algorithm>
#include <cmath>
#include <mutex>
#include <string>
#include <vector>

#include "engine/partition/partition.h"
#include "engine/partition/vertex_blocks.h"

namespace folprom {
namespace {

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
  progress.StartStage("bounds", source.vertex_count(), "vertices");
  std::mutex mutex;
  Bounds bounds;
  const auto extend = [&](size_t block, const std::vector<double>& xyz) {
    if (xyz.empty()) return;
    bool finite = true;
    const Bounds box = BoundsOf(xyz, &finite);
    if (!finite) ThrowAtFirstNotFinite(source, source.vertex_block_begin(block), xyz);
    const std::lock_guard lock(mutex);
    Extend(&bounds, box);
  };
  partition::ForEachVertexBlock(source, runner, progress, extend);
  for (size_t axis = 0; axis < 3; ++axis) {
    // -0 and 0 compare equal, so which of them survives could depend on the order of the blocks.
    bounds.lo[axis] += 0.0;
    bounds.hi[axis] += 0.0;
  }
  return bounds;
}

}  // namespace folprom
