// Sparse map from a voxel coordinate to the number of its statistics. The only place that knows
// OpenVDB, behind a plain interface because its headers are slow to compile.
#pragma once

#include <cstdint>
#include <memory>

#include "engine/mesh/types.h"

namespace folprom::partition {

/// Memory follows the occupied bricks of 8 x 8 x 8 voxels. Not thread-safe.
class VoxelGrid {
 public:
  VoxelGrid();
  ~VoxelGrid();
  VoxelGrid(const VoxelGrid&) = delete;
  VoxelGrid& operator=(const VoxelGrid&) = delete;

  /// The number stored at the coordinate; stores `next` where there is none yet. `next` < 2^31.
  uint32_t FindOrInsert(const Int3& coordinate, uint32_t next);

  /// Where brick `index` of 8 x 8 x 8 voxels begins when bricks are laid out side by side, close
  /// together. `index` < 2^31. Coordinates stay below 2^14.
  static Int3 BrickOrigin(uint32_t index);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace folprom::partition
