// The passes that look at every vertex of the scan before anything is known of it.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/partition/block_pool.h"
#include "engine/partition/resident_pages.h"
#include "io/formats/mesh_source.h"
#include "parallel/progress.h"
#include "parallel/runner.h"

namespace folprom::partition {

/// Calls work(block, xyz) with the coordinates of every block, several at once. Progress counts
/// vertices.
template <class Work>
void ForEachVertexBlock(const io::MeshSource& source, parallel::Runner& runner,
                        parallel::Progress& progress, Work work) {
  // No memory limit is known here; small enough for any.
  constexpr uint64_t kResidentBytes = uint64_t{32} << 20;
  ResidentSource resident_source(source, kResidentBytes);
  BlockPool<std::vector<double>> pool;
  runner.ForEach(source.vertex_block_count(), [&](size_t block) {
    std::vector<double>& xyz = pool.Begin(block);
    source.ReadVertexBlock(block, &xyz).value();
    work(block, xyz);
    const uint64_t vertices = xyz.size() / 3;
    pool.End(block);
    resident_source.TouchedVertices(vertices);
    progress.Advance(vertices);
  });
}

}  // namespace folprom::partition
