#include "engine/mesh/coordinate_planes.h"

#include <algorithm>
#include <utility>

namespace folprom {

CoordinatePlanes::CoordinatePlanes(std::array<std::vector<int32_t>, 3> values) {
  for (size_t a = 0; a < 3; ++a) {
    Axis& axis = axes_[a];
    axis.values = std::move(values[a]);
    if (axis.values.empty()) continue;
    // About as many blocks as planes, so that a look-up passes over one or two.
    const int64_t first = axis.values.front(), last = axis.values.back() - first;
    const auto most_blocks = static_cast<int64_t>(2 * axis.values.size());
    while (last >> axis.block_shift > most_blocks) ++axis.block_shift;
    uint32_t next = 0;
    for (int64_t block = 0; block <= last >> axis.block_shift; ++block) {
      const int64_t begin = first + (block << axis.block_shift);
      while (axis.values[next] < begin) ++next;
      axis.first_of_block.push_back(next);
    }
    axis.first_of_block.push_back(static_cast<uint32_t>(axis.values.size()));
  }
}

bool CoordinatePlanes::empty() const {
  return std::all_of(axes_.begin(), axes_.end(),
                     [](const Axis& axis) { return axis.values.empty(); });
}

}  // namespace folprom
