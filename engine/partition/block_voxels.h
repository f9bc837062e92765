// The voxels of one block of vertices, numbered as they come.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/partition/voxel_statistics.h"

namespace folprom::partition {

/// Coordinates in [0, 2^21). Keeps its memory from block to block.
class BlockVoxels {
 public:
  struct Entry {
    Int3 coordinate;
    Voxel voxel;
  };

  void Clear();
  /// Counts a vertex. Returns the number of its voxel inside this block.
  uint32_t Add(const Int3& coordinate, const Int3& position) {
    if (entries_.empty() || coordinate != entries_[last_].coordinate) last_ = Find(coordinate);
    entries_[last_].voxel.Add(position);
    return last_;
  }
  std::span<const Entry> entries() const { return entries_; }

 private:
  static constexpr uint32_t kEmpty = ~uint32_t{0};
  uint32_t Find(const Int3& coordinate);
  uint32_t& Slot(const Int3& coordinate);
  void Grow();

  std::vector<Entry> entries_;
  std::vector<uint32_t> table_;  // a power of two, at most half full
  uint32_t last_ = 0;
};

}  // namespace folprom::partition
