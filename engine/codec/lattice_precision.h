// Encoder: how coarse positions may be at a layer.
#pragma once

#include <cstdint>
#include <span>

#include "engine/codec/subtree_truth.h"
#include "engine/connectivity/complex.h"
#include "engine/geometry/lattice_coder.h"

namespace folprom {

/// The coarsest precision, no coarser than `coarsest` bits, at which rounding adds little to the
/// error that the `open` sets make because they are not split yet. Linear in the faces.
LatticePrecision ChoosePrecision(const Complex& complex, const SubtreeTruth& truth,
                                 std::span<const uint32_t> open, uint32_t coarsest);

}  // namespace folprom
