// How many vertices lie where: the adaptive voxels that the split works on.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/mesh/types.h"
#include "engine/partition/job.h"
#include "engine/partition/offset_file.h"

namespace folprom::partition {

/// Sums over the vertices of one voxel. Integers, so that no order of summation matters.
struct Voxel {
  int64_t count = 0;  ///< 0: the voxel was replaced by finer ones
  std::array<int64_t, 3> sum{};
  Int3 lo, hi;  ///< tight box of the vertices

  void Add(const Int3& position) {
    if (count == 0) lo = hi = position;
    ++count;
    sum[0] += position.x;
    sum[1] += position.y;
    sum[2] += position.z;
    lo = {std::min(lo.x, position.x), std::min(lo.y, position.y), std::min(lo.z, position.z)};
    hi = {std::max(hi.x, position.x), std::max(hi.y, position.y), std::max(hi.z, position.z)};
  }
  void Add(const Voxel& other);
};

/// Writes a VertexRecord per vertex of the scan, in the order of the file, and returns the voxels
/// that they name. A voxel with more than VoxelVertexLimit vertices only stands where all vertices
/// fit into one subtree. The numbers of the voxels mean nothing; they are fewer than 2^31.
/// Failure kLimit where that is not enough.
std::vector<Voxel> CollectVoxels(Job& job, OffsetFile& records);

}  // namespace folprom::partition
