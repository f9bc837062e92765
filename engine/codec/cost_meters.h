// Where the bits of a subtree go.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/connectivity/split_coder.h"
#include "engine/geometry/offset_coder.h"

namespace folprom {

/// Costs in 1/1024 bit. The six kinds in the table of a file are these, root and offsets together,
/// and refinement and rests.
struct CostMeters {
  uint64_t split = 0, root = 0, refinement = 0, exceptions = 0, seams = 0, rests = 0;
  OffsetMeters offsets;
  SplitMeters connectivity;
  std::vector<uint64_t> attributes;  ///< per attribute of the vertices; of the roots all in `root`

  CostMeters& operator+=(const CostMeters& other);
};

}  // namespace folprom
