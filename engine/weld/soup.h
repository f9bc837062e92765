// Scans whose faces share no vertices.
#pragma once

#include <cstdint>

#include "folprom/settings.h"
#include "io/formats/mesh_source.h"

namespace folprom {

/// Is there a triangle, is triangle i of the vertices 3 i, 3 i + 1 and 3 i + 2, and are there no
/// other vertices. Reads triangles up to the first that is not so. Throws Failure.
bool IsSoup(const io::MeshSource& source);

/// What becomes of a scan before all else.
enum class WeldKind : uint8_t {
  kAsItIs = 0,
  kSoup,    ///< it is welded, and comes back as it was
  kSurface  ///< it is welded
};
/// Failure kInput where a scan that is to be welded has attributes that are kept.
WeldKind WeldFor(const io::MeshSource& source, const EncodeOptions& options);

}  // namespace folprom
