// The plain mesh that the tests work on.
#pragma once

#include <array>
#include <cstdint>

#include "folprom/decoder.h"

namespace folprom::support {

/// Positions in model units, faces as indices into them.
using Mesh = DecodedMesh;
using Point = std::array<double, 3>;
using Triple = std::array<uint64_t, 3>;

}  // namespace folprom::support
