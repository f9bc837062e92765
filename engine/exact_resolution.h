// Which lattice an exact encoding goes by.
#pragma once

#include "engine/mesh/lattice.h"
#include "engine/partition/coordinate_census.h"

namespace folprom {

/// A lattice of a decimal or binary step. Where the coordinates lie on one, it is that; otherwise
/// one on which enough of them lie, or that is as fine as predictions can use. has_rests is true.
Lattice ExactLatticeFor(const CoordinateCensus& census, bool is_float);

}  // namespace folprom
