// Coordinates that many vertices of a scan share: planes at a right angle to an axis. A surface cut
// out of voxels has two or three of each vertex's coordinates on them, a drawn part its flat sides.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace folprom {

/// Lattice units throughout.
class CoordinatePlanes {
 public:
  CoordinatePlanes() = default;
  /// values: of each axis, ascending, each once.
  explicit CoordinatePlanes(std::array<std::vector<int32_t>, 3> values);

  bool empty() const;
  std::span<const int32_t> On(uint32_t axis) const { return axes_[axis].values; }
  /// Number of planes of the axis that lie below the coordinate.
  size_t Below(uint32_t axis, int64_t coordinate) const {
    const Axis& on = axes_[axis];
    if (on.values.empty() || coordinate <= on.values.front()) return 0;
    if (coordinate > on.values.back()) return on.values.size();
    const auto block = static_cast<size_t>((coordinate - on.values.front()) >> on.block_shift);
    const auto begin = on.values.begin() + on.first_of_block[block];
    const auto end = on.values.begin() + on.first_of_block[block + 1];
    return static_cast<size_t>(std::lower_bound(begin, end, coordinate) - on.values.begin());
  }
  /// Is there a plane in [begin, end).
  bool Any(uint32_t axis, int64_t begin, int64_t end) const {
    return Below(axis, end) > Below(axis, begin);
  }

 private:
  struct Axis {
    std::vector<int32_t> values;
    uint32_t block_shift = 0;
    std::vector<uint32_t>
        first_of_block;  ///< first plane at or behind each begin, and the last end
  };
  std::array<Axis, 3> axes_;
};

}  // namespace folprom
