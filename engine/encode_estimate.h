// What an encoding will take, told before it begins.
#pragma once

#include <cstdint>
#include <string>

#include "folprom/settings.h"
#include "io/files/free_space.h"
#include "io/formats/mesh_source.h"

namespace folprom {

/// A scan, and how many vertices of it are coded.
struct ExpectedScan {
  const io::MeshSource& source;
  uint64_t vertices = 0;
  bool is_welded = false;  ///< before that
};

/// Temporary disk at the peak, which is the end of the partition; without the weld.
uint64_t EstimateSpillBytes(const ExpectedScan& scan, const EncodeOptions& options);

/// Bytes of the output. Reads a few blocks of the scan.
uint64_t EstimateFileBytes(const ExpectedScan& scan, const EncodeOptions& options);

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
