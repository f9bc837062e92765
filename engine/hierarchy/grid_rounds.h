// Regular grids, as depth cameras measure them: which vertices to remove so that grids stay.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/mesh/types.h"

namespace folprom {

/// A vertex to contract into one of two neighbours, the first if it can be; kNoTarget: missing.
struct GridStep {
  static constexpr uint32_t kNoTarget = ~uint32_t{0};
  uint32_t vertex;
  std::array<uint32_t, 2> targets;
};

/// One list of steps per round; each round removes every second row or every second column of each
/// grid, whichever lie closer. No rounds where less than half of the vertices lie on grids. A grid
/// is a component whose vertices can be labelled with (row, column) so that any two faces with a
/// common edge form a parallelogram.
std::vector<std::vector<GridStep>> PlanGridRounds(std::span<const Int3> positions,
                                                  std::span<const Face> faces,
                                                  uint32_t most_rounds);

}  // namespace folprom
