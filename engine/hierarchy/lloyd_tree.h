// The paper's hierarchy: vertex sets split top-down by the generalized Lloyd algorithm
// (section 2.1).
#pragma once

#include <cstdint>
#include <span>

#include "engine/hierarchy/set_tree.h"
#include "engine/hierarchy/surface.h"
#include "engine/mesh/types.h"
#include "folprom/settings.h"

namespace folprom {

/// `longest_side`: of the whole mesh's box in lattice units; the metric sees it as 4096. At least
/// one vertex. Single-threaded and the same on every machine.
SetTree BuildLloydTree(std::span<const Int3> positions, const SurfaceAttributes& surface,
                       double longest_side, const CodecSettings& settings);

}  // namespace folprom
