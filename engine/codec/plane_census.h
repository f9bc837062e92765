// Finds the coordinates that many vertices of a subtree share. Encoder only.
#pragma once

#include <memory>
#include <span>

#include "engine/mesh/coordinate_planes.h"
#include "engine/mesh/types.h"

namespace folprom {

/// Null where no axis has planes that are worth their place in the file.
std::shared_ptr<const CoordinatePlanes> FindPlanes(std::span<const Int3> positions);

}  // namespace folprom
