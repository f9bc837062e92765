// What every pass of one partition shares.
#pragma once

#include <cstdint>

#include "engine/partition/partition.h"
#include "engine/partition/resident_pages.h"

namespace folprom::partition {

/// A vertex between the passes: its place on the lattice and the voxel that counts it.
struct VertexRecord {
  Int3 position;
  uint32_t voxel = 0;
};
static_assert(sizeof(VertexRecord) == 16);

/// A voxel that holds more vertices than this is refined, or cut where it is a single point, so
/// that the split has pieces to balance with. At least 1.
uint32_t VoxelVertexLimit(const PartitionSettings& settings);

/// The arguments of PartitionScan.
struct Job {
  const io::MeshSource& source;
  const Lattice& lattice;
  const PartitionSettings& settings;
  const bool with_attributes;
  const uint64_t memory_bytes;
  parallel::Runner& runner;
  const io::SpillDirectory& spill;
  parallel::Progress& progress;
  ResidentSource resident_source{source, memory_bytes / 8};

  /// Blocks in flight at once: enough to keep the threads busy, within an eighth of the memory.
  size_t Window() const;
};

}  // namespace folprom::partition
