// The binary splits by which K children come about (section 3.2 repeats the binary split).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/connectivity/complex.h"
#include "engine/mesh/types.h"

namespace folprom {

/// Children that one binary split or a single child stands for.
struct ChildGroup {
  Int3 position;                           ///< mean of the children, rounded down
  uint32_t first = kNone, second = kNone;  ///< groups inside, kNone for a child
  std::vector<uint32_t> places;            ///< of the children
};

/// The nearest two are parted last. The children come first, in their order; the last group holds
/// them all.
std::vector<ChildGroup> GroupChildren(std::span<const Int3> positions);

}  // namespace folprom
