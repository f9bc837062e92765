// The passes in their order, and the scan that they leave on disk.
#include "engine/partition/partition.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/partition/job.h"
#include "engine/partition/offset_file.h"
#include "engine/partition/scatter.h"
#include "engine/partition/voxel_normals.h"
#include "engine/partition/voxel_split.h"
#include "engine/partition/voxel_statistics.h"

namespace folprom {
namespace partition {
namespace {

// Larger buffers would only leave the cache before they are written.
constexpr uint64_t kBufferBytes = 64 << 10;

uint64_t BufferBytes(size_t streams, uint64_t memory_bytes) {
  return std::min(memory_bytes / 16, streams * kBufferBytes);
}

class SpilledScan final : public PartitionedScan {
 public:
  /// with_exact: keep the coordinates of the scan beside those on the lattice.
  SpilledScan(const io::SpillDirectory& spill, std::vector<SubtreeSummary> subtrees,
              uint64_t memory_bytes, bool with_exact, bool with_attributes)
      : subtrees_(std::move(subtrees)),
        positions_(spill, "partition.positions", subtrees_.size(),
                   BufferBytes(subtrees_.size(), memory_bytes)),
        faces_(spill, "partition.faces", subtrees_.size(),
               BufferBytes(subtrees_.size(), memory_bytes / 2)),
        cross_faces_(spill, "partition.cross", subtrees_.size(),
                     BufferBytes(subtrees_.size(), memory_bytes / 2)) {
    const uint64_t buffers = BufferBytes(subtrees_.size(), memory_bytes);
    if (with_exact) exact_.emplace(spill, "partition.exact", subtrees_.size(), buffers);
    if (with_attributes) {
      attributes_.emplace(spill, "partition.attributes", subtrees_.size(), buffers);
    }
  }

  /// One whose streams are there already.
  SpilledScan(const io::SpillDirectory& spill, std::vector<SubtreeSummary> subtrees,
              std::vector<io::AttributeRange> ranges, bool with_exact, size_t attribute_bytes,
              uint64_t peak_spill_bytes)
      : subtrees_(std::move(subtrees)),
        positions_(spill, "partition.positions", VertexBytes(sizeof(Int3))),
        faces_(spill, "partition.faces", FaceBytes(sizeof(Face), &SubtreeSummary::faces)),
        cross_faces_(spill, "partition.cross",
                     FaceBytes(sizeof(CrossFace), &SubtreeSummary::cross_faces)),
        ranges_(std::move(ranges)),
        peak_spill_bytes_(peak_spill_bytes) {
    if (with_exact) exact_.emplace(spill, "partition.exact", VertexBytes(sizeof(ExactPosition)));
    if (attribute_bytes > 0) {
      attributes_.emplace(spill, "partition.attributes", VertexBytes(attribute_bytes));
    }
  }

  /// The two scatter passes.
  void Fill(Job& job, const OffsetFile& records, std::span<const uint32_t> subtree_of_voxel) {
    OffsetFile refs(job.spill, "partition.vertex_map");
    const VertexStreams streams{&positions_, exact_ ? &*exact_ : nullptr,
                                attributes_ ? &*attributes_ : nullptr};
    ranges_ = ScatterVertices(job, records, subtree_of_voxel, subtrees_.size(), refs, streams);
    positions_.Finish();
    if (exact_) exact_->Finish();
    if (attributes_) attributes_->Finish();
    vertex_map_ = refs.Map();
    ScatterFaces(job, records.Map(), vertex_map_, faces_, cross_faces_, subtrees_);
    faces_.Finish();
    cross_faces_.Finish();
    peak_spill_bytes_ = job.spill.SizeBytes();
  }

  size_t subtree_count() const override { return subtrees_.size(); }
  const SubtreeSummary& summary(size_t subtree) const override { return subtrees_[subtree]; }

  SubtreeChunk Load(size_t subtree) const override {
    SubtreeChunk chunk;
    chunk.storage.push_back(positions_.Map(subtree));
    chunk.storage.push_back(faces_.Map(subtree));
    chunk.storage.push_back(cross_faces_.Map(subtree));
    chunk.positions = io::MappedArray<Int3>(chunk.storage[0]);
    chunk.faces = io::MappedArray<Face>(chunk.storage[1]);
    chunk.cross_faces = io::MappedArray<CrossFace>(chunk.storage[2]);
    if (exact_) {
      chunk.storage.push_back(exact_->Map(subtree));
      chunk.exact = io::MappedArray<ExactPosition>(chunk.storage.back());
    }
    if (attributes_) {
      chunk.storage.push_back(attributes_->Map(subtree));
      chunk.attributes = chunk.storage.back().bytes();
    }
    return chunk;
  }

  uint64_t peak_spill_bytes() const override { return peak_spill_bytes_; }
  std::span<const io::AttributeRange> attribute_ranges() const override { return ranges_; }

  std::span<const VertexRef> vertex_map() const override {
    return io::MappedArray<VertexRef>(vertex_map_);
  }

 private:
  std::vector<uint64_t> VertexBytes(uint64_t each) const {
    std::vector<uint64_t> bytes;
    for (const SubtreeSummary& subtree : subtrees_) bytes.push_back(subtree.vertices * each);
    return bytes;
  }
  std::vector<uint64_t> FaceBytes(uint64_t each, uint64_t SubtreeSummary::*count) const {
    std::vector<uint64_t> bytes;
    for (const SubtreeSummary& subtree : subtrees_) bytes.push_back(subtree.*count * each);
    return bytes;
  }

  std::vector<SubtreeSummary> subtrees_;
  io::SpillStreams positions_;
  io::SpillStreams faces_;
  io::SpillStreams cross_faces_;
  std::optional<io::SpillStreams> exact_, attributes_;
  std::vector<io::AttributeRange> ranges_;
  io::MappedFile vertex_map_;
  uint64_t peak_spill_bytes_ = 0;
};

std::unique_ptr<PartitionedScan> Run(Job& job) {
  const uint64_t vertices = job.source.vertex_count(), triangles = job.source.triangle_count();
  const bool needs_normals = vertices > job.settings.subtree_vertices && job.settings.normal_metric;
  job.progress.StartStage("partition", 2 * vertices + (needs_normals ? 2 : 1) * triangles);

  OffsetFile records(job.spill, "partition.vertices");
  const std::vector<Voxel> voxels = CollectVoxels(job, records);
  std::vector<NormalSum> normals;
  if (needs_normals) normals = CollectNormals(job, records.Map(), voxels.size());
  VoxelSplit split = SplitVoxels(voxels, normals, job.lattice, job.settings);
  job.progress.ThrowIfCancelled();

  const bool with_exact = job.lattice.exact && job.lattice.exact->step.has_rests;
  auto scan = std::make_unique<SpilledScan>(job.spill, std::move(split.subtrees), job.memory_bytes,
                                            with_exact, job.with_attributes);
  scan->Fill(job, records, split.subtree);
  records.Remove();
  return scan;
}

}  // namespace
}  // namespace partition

std::unique_ptr<PartitionedScan> PartitionScan(const io::MeshSource& source, const Lattice& lattice,
                                               const PartitionSettings& settings,
                                               uint64_t memory_bytes, parallel::Runner& runner,
                                               const io::SpillDirectory& spill,
                                               parallel::Progress& progress, bool with_attributes) {
  if (settings.subtree_vertices == 0) {
    throw Failure(ErrorKind::kUsage, "subtree_vertices must be at least 1");
  }
  with_attributes &= !source.vertex_schema().attributes.empty();
  partition::Job job{source,       lattice, settings, with_attributes,
                     memory_bytes, runner,  spill,    progress};
  return partition::Run(job);
}

std::unique_ptr<PartitionedScan> ReopenScan(const io::SpillDirectory& spill,
                                            std::vector<SubtreeSummary> summaries,
                                            std::vector<io::AttributeRange> ranges, bool with_exact,
                                            size_t attribute_bytes, uint64_t peak_spill_bytes) {
  return std::make_unique<partition::SpilledScan>(spill, std::move(summaries), std::move(ranges),
                                                  with_exact, attribute_bytes, peak_spill_bytes);
}

}  // namespace folprom
