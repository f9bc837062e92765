#include "engine/partition/voxel_statistics.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/partition/block_pool.h"
#include "engine/partition/block_voxels.h"
#include "engine/partition/voxel_grid.h"

namespace folprom::partition {
namespace {

constexpr uint32_t kMaxVoxels = uint32_t{1} << 31;
// Marks a number inside a block, until the block's voxels have their numbers in the whole scan.
constexpr uint32_t kInBlock = uint32_t{1} << 31;

// The first grid: about this many voxels a subtree. Fewer make uneven cuts, more a slow split.
constexpr double kVoxelsPerSubtree = 128;
constexpr double kMaxVoxelsPerSide = 1 << 20;

struct Block {
  std::vector<double> xyz;
  std::vector<VertexRecord> records;
  BlockVoxels voxels;
  std::vector<uint32_t> cut;  // records that lie in a voxel to cut
};

uint64_t FirstVertex(const Job& job, size_t block) { return job.source.vertex_block_begin(block); }

size_t VertexCount(const Job& job, size_t block) {
  return static_cast<size_t>(FirstVertex(job, block + 1) - FirstVertex(job, block));
}

uint32_t NextNumber(const Job& job, const std::vector<Voxel>& voxels) {
  if (voxels.size() >= kMaxVoxels) {
    throw Failure(ErrorKind::kLimit, job.source.path() + ": more than " +
                                         std::to_string(kMaxVoxels) +
                                         " voxels; use larger subtrees");
  }
  return static_cast<uint32_t>(voxels.size());
}

// Joins the voxels of a block with those of the blocks before it and writes its records.
void Merge(Job& job, size_t block, Block& state, VoxelGrid& grid, std::vector<Voxel>& voxels,
           OffsetFile& records) {
  std::vector<uint32_t> number;
  for (const BlockVoxels::Entry& entry : state.voxels.entries()) {
    const uint32_t next = NextNumber(job, voxels);
    number.push_back(grid.FindOrInsert(entry.coordinate, next));
    if (number.back() == next) voxels.emplace_back();
    voxels[number.back()].Add(entry.voxel);
  }
  for (VertexRecord& record : state.records) {
    if ((record.voxel & kInBlock) != 0) record.voxel = number[record.voxel & ~kInBlock];
  }
  records.WriteRecords<VertexRecord>(FirstVertex(job, block), state.records);
}

// Voxels per lattice step of the first grid. A surface meets about as many voxels as faces of its
// box would. 0: everything is one voxel.
double FirstResolution(const Job& job) {
  const auto vertices = static_cast<double>(job.source.vertex_count());
  const double subtree = static_cast<double>(job.settings.subtree_vertices);
  if (vertices <= subtree) return 0;
  const double wanted =
      std::max(std::min(kVoxelsPerSubtree * vertices / subtree, vertices / 8), 1.0);
  const auto& extent = job.lattice.extent;
  const double x = extent[0], y = extent[1], z = extent[2];
  const double longest = std::max({x, y, z});
  const double side = std::max({std::sqrt((x * y + y * z + z * x) / wanted), longest / wanted,
                                longest / kMaxVoxelsPerSide, 1.0});
  return 1 / side;
}

std::vector<Voxel> FirstVoxels(Job& job, OffsetFile& records) {
  const double resolution = FirstResolution(job);
  const auto coordinate = [resolution](int32_t k) {
    return static_cast<int32_t>(static_cast<double>(k) * resolution);
  };
  BlockPool<Block> pool;
  VoxelGrid grid;
  std::vector<Voxel> voxels;
  const auto produce = [&](size_t block) {
    Block& state = pool.Begin(block);
    job.source.ReadVertexBlock(block, &state.xyz).value();
    const size_t count = VertexCount(job, block);
    job.resident_source.TouchedVertices(count);
    state.records.resize(count);
    state.voxels.Clear();
    for (size_t i = 0; i < count; ++i) {
      const Int3 k = job.lattice.FromModel(&state.xyz[3 * i]);
      const Int3 voxel{coordinate(k.x), coordinate(k.y), coordinate(k.z)};
      state.records[i] = {k, kInBlock | state.voxels.Add(voxel, k)};
    }
  };
  const auto consume = [&](size_t block) {
    Merge(job, block, pool.At(block), grid, voxels, records);
    pool.End(block);
    job.progress.Advance(VertexCount(job, block));
  };
  job.runner.Ordered(job.source.vertex_block_count(), job.Window(), produce, consume);
  return voxels;
}

// A voxel that is replaced by finer ones: at most 8 x 8 x 8 that fill its tight box.
struct Brick {
  Int3 origin;    // on the lattice
  int shift = 0;  // side of the finer voxels is 2^shift
  Int3 corner;    // in the grid

  Brick(const Voxel& voxel, uint32_t index, int64_t limit)
      : origin(voxel.lo), corner(VoxelGrid::BrickOrigin(index)) {
    const int32_t extent =
        std::max({voxel.hi.x - voxel.lo.x, voxel.hi.y - voxel.lo.y, voxel.hi.z - voxel.lo.z});
    const int32_t cells = voxel.count > 8 * limit ? 8 : 4;
    while ((extent >> shift) >= cells) ++shift;
  }

  Int3 Coordinate(const Int3& position) const {
    return {corner.x + ((position.x - origin.x) >> shift),
            corner.y + ((position.y - origin.y) >> shift),
            corner.z + ((position.z - origin.z) >> shift)};
  }
};

struct Refinement {
  static constexpr uint32_t kKeep = ~uint32_t{0};
  std::vector<Brick> bricks;
  std::vector<uint32_t> brick_of;  // per voxel, or kKeep
};

// Takes the voxels that are too full and not a single point out of the table.
Refinement TakeFullVoxels(std::vector<Voxel>& voxels, int64_t limit) {
  Refinement refinement;
  refinement.brick_of.assign(voxels.size(), Refinement::kKeep);
  for (size_t i = 0; i < voxels.size(); ++i) {
    if (voxels[i].count <= limit || voxels[i].lo == voxels[i].hi) continue;
    const auto index = static_cast<uint32_t>(refinement.bricks.size());
    refinement.brick_of[i] = index;
    refinement.bricks.emplace_back(voxels[i], index, limit);
    voxels[i] = Voxel{};
  }
  return refinement;
}

void Refine(Job& job, const Refinement& refinement, std::vector<Voxel>& voxels,
            OffsetFile& records) {
  BlockPool<Block> pool;
  VoxelGrid grid;
  const auto produce = [&](size_t block) {
    Block& state = pool.Begin(block);
    state.records.resize(VertexCount(job, block));
    records.ReadRecords<VertexRecord>(FirstVertex(job, block), state.records);
    state.voxels.Clear();
    for (VertexRecord& record : state.records) {
      const uint32_t index = refinement.brick_of[record.voxel];
      if (index == Refinement::kKeep) continue;
      const Int3 voxel = refinement.bricks[index].Coordinate(record.position);
      record.voxel = kInBlock | state.voxels.Add(voxel, record.position);
    }
  };
  const auto consume = [&](size_t block) {
    Block& state = pool.At(block);
    if (!state.voxels.entries().empty()) Merge(job, block, state, grid, voxels, records);
    pool.End(block);
    job.progress.ThrowIfCancelled();
  };
  job.runner.Ordered(job.source.vertex_block_count(), job.Window(), produce, consume);
}

// A single point that holds too many vertices: pieces in the order of the file.
struct Cut {
  uint32_t first_piece = 0;
  uint64_t seen = 0;
};

// The pieces join the table; returns, per voxel, its index in *cuts or kKeep.
std::vector<uint32_t> TakeFullPoints(const Job& job, std::vector<Voxel>& voxels, int64_t limit,
                                     std::vector<Cut>* cuts) {
  std::vector<uint32_t> cut_of(voxels.size(), Refinement::kKeep);
  for (size_t i = 0; i < cut_of.size(); ++i) {
    if (voxels[i].count <= limit) continue;
    const Voxel whole = voxels[i];
    cut_of[i] = static_cast<uint32_t>(cuts->size());
    cuts->push_back({NextNumber(job, voxels), 0});
    for (int64_t left = whole.count; left > 0; left -= limit) {
      NextNumber(job, voxels);
      Voxel piece = whole;
      piece.count = std::min(left, limit);
      piece.sum = {piece.count * whole.lo.x, piece.count * whole.lo.y, piece.count * whole.lo.z};
      voxels.push_back(piece);
    }
    voxels[i] = Voxel{};
  }
  return cut_of;
}

void CutPoints(Job& job, const std::vector<uint32_t>& cut_of, std::vector<Cut>& cuts,
               uint64_t limit, OffsetFile& records) {
  BlockPool<Block> pool;
  const auto produce = [&](size_t block) {
    Block& state = pool.Begin(block);
    state.records.resize(VertexCount(job, block));
    records.ReadRecords<VertexRecord>(FirstVertex(job, block), state.records);
    state.cut.clear();
    for (uint32_t i = 0; i < state.records.size(); ++i) {
      if (cut_of[state.records[i].voxel] != Refinement::kKeep) state.cut.push_back(i);
    }
  };
  const auto consume = [&](size_t block) {
    Block& state = pool.At(block);
    for (uint32_t i : state.cut) {
      Cut& cut = cuts[cut_of[state.records[i].voxel]];
      state.records[i].voxel = cut.first_piece + static_cast<uint32_t>(cut.seen++ / limit);
    }
    if (!state.cut.empty()) {
      records.WriteRecords<VertexRecord>(FirstVertex(job, block), state.records);
    }
    pool.End(block);
    job.progress.ThrowIfCancelled();
  };
  job.runner.Ordered(job.source.vertex_block_count(), job.Window(), produce, consume);
}

}  // namespace

void Voxel::Add(const Voxel& other) {
  if (other.count == 0) return;
  if (count == 0) {
    *this = other;
    return;
  }
  count += other.count;
  for (size_t axis = 0; axis < 3; ++axis) sum[axis] += other.sum[axis];
  lo = {std::min(lo.x, other.lo.x), std::min(lo.y, other.lo.y), std::min(lo.z, other.lo.z)};
  hi = {std::max(hi.x, other.hi.x), std::max(hi.y, other.hi.y), std::max(hi.z, other.hi.z)};
}

std::vector<Voxel> CollectVoxels(Job& job, OffsetFile& records) {
  std::vector<Voxel> voxels = FirstVoxels(job, records);
  if (job.source.vertex_count() <= job.settings.subtree_vertices) return voxels;

  const uint32_t limit = VoxelVertexLimit(job.settings);
  while (true) {
    const Refinement refinement = TakeFullVoxels(voxels, limit);
    if (refinement.bricks.empty()) break;
    Refine(job, refinement, voxels, records);
  }
  std::vector<Cut> cuts;
  const std::vector<uint32_t> cut_of = TakeFullPoints(job, voxels, limit, &cuts);
  if (!cuts.empty()) CutPoints(job, cut_of, cuts, limit, records);
  return voxels;
}

}  // namespace folprom::partition
