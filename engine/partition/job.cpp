#include "engine/partition/job.h"

#include <algorithm>

namespace folprom::partition {
namespace {

// A block of 65,536 triangles with indices, grouped faces and the same again as cross faces.
constexpr uint64_t kBlockBytes = uint64_t{8} << 20;

}  // namespace

uint32_t VoxelVertexLimit(const PartitionSettings& settings) {
  return std::max<uint32_t>(settings.subtree_vertices / 16, 1);
}

size_t Job::Window() const {
  // Attributes as they are read, and by subtree.
  const size_t stride = with_attributes ? source.vertex_schema().Stride() : 0;
  const uint64_t block_bytes = kBlockBytes + 2 * io::kBlockVertices * stride;
  const uint64_t affordable = std::max<uint64_t>(memory_bytes / 8 / block_bytes, 1);
  const uint64_t useful = 2 * static_cast<uint64_t>(runner.threads()) + 2;
  return static_cast<size_t>(std::min(affordable, useful));
}

}  // namespace folprom::partition
