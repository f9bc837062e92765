// Files that an encoder with a lying truth writes: every byte is well formed, the content is not.
#pragma once

#include <cstdint>

#include "tests/hostile/support.h"

namespace folprom::hostile {

/// A mesh of one subtree in which every pair of `vertices` vertices is an edge, and which announces
/// `announced_faces` faces.
Bytes CompleteGraphFile(uint32_t vertices, uint64_t announced_faces);

/// A torus of 100 vertices each face of which claims `copies` copies. The table announces no copy.
Bytes CopiedFacesFile(uint32_t copies);

}  // namespace folprom::hostile
