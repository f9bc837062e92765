// What an encoding will take, told before it begins.
#pragma once

#include <cstdint>
#include <string>

#include "folprom/settings.h"
#include "io/files/free_space.h"
#include "io/formats/mesh_source.h"

namespace folprom {

/// Temporary disk at the peak, which is the end of the partition.
uint64_t EstimateSpillBytes(const io::MeshSource& source, const EncodeOptions& options);

/// Bytes of the output. Reads a few blocks of the scan.
uint64_t EstimateFileBytes(const io::MeshSource& source, const EncodeOptions& options);

/// A folder, its disk, and what is to be written there.
struct RoomNeeded {
  std::string folder;
  io::Volume volume;
  uint64_t bytes = 0;
};
/// Failure kOutput, with folder and sizes, where either disk has less room than it needs, or both
/// are one that has less than both need.
void CheckRoom(const RoomNeeded& spill, const RoomNeeded& output);

}  // namespace folprom
