#include "engine/partition/voxel_normals.h"

#include <atomic>
#include <cmath>

#include "engine/partition/block_pool.h"

namespace folprom::partition {
namespace {

constexpr double kSteps = 1 << 15;

// Sums of one block, handed on to the sums of all when another voxel wants their place. Triangles
// that follow each other share voxels, so the shared sums are rarely touched.
class NormalCache {
 public:
  void Add(uint32_t voxel, const NormalSum& normal, int64_t times, std::vector<NormalSum>& sums) {
    Line& line = lines_[voxel % kLines];
    if (line.voxel != voxel) {
      Flush(line, sums);
      line.voxel = voxel;
    }
    for (size_t axis = 0; axis < 3; ++axis) line.sum[axis] += times * normal[axis];
  }

  void Flush(std::vector<NormalSum>& sums) {
    for (Line& line : lines_) Flush(line, sums);
  }

 private:
  static constexpr size_t kLines = 256;
  struct Line {
    uint32_t voxel = 0;
    NormalSum sum{};
  };

  static void Flush(Line& line, std::vector<NormalSum>& sums) {
    for (size_t axis = 0; axis < 3; ++axis) {
      if (line.sum[axis] == 0) continue;
      std::atomic_ref(sums[line.voxel][axis]).fetch_add(line.sum[axis], std::memory_order_relaxed);
      line.sum[axis] = 0;
    }
  }

  std::array<Line, kLines> lines_;
};

struct Block {
  std::vector<io::Triangle> triangles;
  NormalCache cache;
};

NormalSum UnitNormal(const Int3& a, const Int3& b, const Int3& c) {
  const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
  const double vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  const double x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
  const double squared = x * x + y * y + z * z;
  if (squared == 0) return {};
  const double scale = kSteps / std::sqrt(squared);
  return {static_cast<int64_t>(x * scale), static_cast<int64_t>(y * scale),
          static_cast<int64_t>(z * scale)};
}

}  // namespace

std::vector<NormalSum> CollectNormals(Job& job, const io::MappedFile& records, size_t voxel_count) {
  const std::span<const VertexRecord> vertices = io::MappedArray<VertexRecord>(records);
  ResidentPages resident(records, job.memory_bytes / 8);
  const auto vertex = [&](uint64_t index) -> const VertexRecord& {
    resident.Touch(index * sizeof(VertexRecord));
    return vertices[index];
  };
  std::vector<NormalSum> sums(voxel_count);
  BlockPool<Block> pool;
  job.runner.ForEach(job.source.triangle_block_count(), [&](size_t index) {
    Block& block = pool.Begin(index);
    job.source.ReadTriangleBlock(index, &block.triangles).value();
    const uint64_t count = block.triangles.size();
    job.resident_source.TouchedTriangles(count);
    for (const io::Triangle& corner : block.triangles) {
      const VertexRecord &a = vertex(corner[0]), &b = vertex(corner[1]), &c = vertex(corner[2]);
      const NormalSum normal = UnitNormal(a.position, b.position, c.position);
      if (a.voxel == b.voxel && b.voxel == c.voxel) {
        block.cache.Add(a.voxel, normal, 3, sums);
        continue;
      }
      block.cache.Add(a.voxel, normal, 1, sums);
      block.cache.Add(b.voxel, normal, 1, sums);
      block.cache.Add(c.voxel, normal, 1, sums);
    }
    block.cache.Flush(sums);
    pool.End(index);
    job.progress.Advance(count);
  });
  return sums;
}

}  // namespace folprom::partition
