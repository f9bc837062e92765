// Runs the partition on a scan in memory and compares all of it with the mesh.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/partition/partition.h"
#include "test_meshes.h"

namespace folprom::partition {

struct TestScan {
  std::unique_ptr<io::SpillDirectory> spill;
  std::unique_ptr<PartitionedScan> scan;
};

constexpr uint64_t kTestMemory = uint64_t{64} << 20;

/// On one thread with kTestMemory.
TestScan PartitionOf(const TestSource& source, const Lattice& lattice,
                     const PartitionSettings& settings);

TestScan PartitionOf(const TestSource& source, const Lattice& lattice,
                     const PartitionSettings& settings, uint64_t memory_bytes,
                     parallel::Runner& runner);

/// Expects what partition.h promises: each vertex in one subtree of a legal size, each face where
/// it belongs, all in the order of the file, boxes, counts and neighbours right.
void ExpectComplete(const TestSource& source, const Lattice& lattice,
                    const PartitionSettings& settings, const PartitionedScan& scan);

/// Both of the above.
TestScan CheckedPartitionOf(const TestSource& source, int bits, uint32_t subtree_vertices);

/// Everything that the scan left on disk, and its summaries.
std::vector<uint8_t> BytesOf(const PartitionedScan& scan);

}  // namespace folprom::partition
