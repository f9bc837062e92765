// Numbers the vertices of a scan of any size by their coordinates.
#pragma once

#include <cstdint>

#include "io/files/mapped_file.h"
#include "io/formats/mesh_source.h"
#include "io/spill/spill.h"
#include "parallel/progress.h"
#include "parallel/runner.h"

namespace folprom {

/// Vertices whose coordinates have the same bits have the same number; the numbers ascend with the
/// vertices that have them first.
struct PositionWeld {
  uint64_t count = 0;        ///< of the numbers
  io::MappedFile numbers;    ///< of each vertex, as uint64_t
  io::MappedFile positions;  ///< of each number, as PackedPosition packs it
  uint64_t peak_spill_bytes = 0;
};

/// Both files are all that is left in `spill`. Depends on the scan alone. Throws Failure.
PositionWeld WeldPositions(const io::MeshSource& source, uint64_t memory_bytes,
                           const io::SpillDirectory& spill, parallel::Runner& runner,
                           parallel::Progress& progress);

/// Temporary disk at the peak where no two vertices have the same coordinates.
uint64_t WeldSpillBytes(const io::MeshSource& source);

}  // namespace folprom
