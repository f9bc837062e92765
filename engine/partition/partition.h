// Cuts a scan of any size into subtrees in streaming passes; holds no mesh in memory.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/mesh/lattice.h"
#include "engine/mesh/types.h"
#include "io/formats/mesh_source.h"
#include "io/spill/spill.h"
#include "parallel/progress.h"
#include "parallel/runner.h"

namespace folprom {

/// The part of the settings that decides where the cuts lie. Nothing here may come from the
/// machine.
struct PartitionSettings {
  uint32_t subtree_vertices = 100000;  ///< largest number of vertices in a subtree, at least 1
  double metric_a = 1;                 ///< section 2.1
  double metric_b = 8;                 ///< section 2.1
  bool normal_metric = true;           ///< false: Euclidean distance only
};

/// One subtree, mapped from the spill. Valid while the object lives.
struct SubtreeChunk {
  std::span<const Int3> positions;         ///< vertices in the order of the input file
  std::span<const Face> faces;             ///< faces that lie wholly inside, local indices
  std::span<const CrossFace> cross_faces;  ///< faces that touch it and another one
  std::vector<io::MappedFile> storage;
  std::span<const ExactPosition> exact = {};  ///< as in the input, where the lattice leaves rests
  /// Vertex by vertex as the source gives them, where they are kept.
  std::span<const uint8_t> attributes = {};
};

struct SubtreeSummary {
  uint32_t vertices = 0;
  uint64_t faces = 0;                ///< wholly inside
  uint64_t cross_faces = 0;          ///< touching
  Int3 box_lo, box_hi;               ///< of its vertices
  std::vector<uint32_t> neighbours;  ///< subtrees that share a face with it, ascending
};

/// The scan after the partition. Subtree numbers follow the split tree, so neighbours in number are
/// near in space. Load is thread-safe.
class PartitionedScan {
 public:
  virtual ~PartitionedScan() = default;
  virtual size_t subtree_count() const = 0;
  virtual const SubtreeSummary& summary(size_t subtree) const = 0;
  virtual SubtreeChunk Load(size_t subtree) const = 0;
  /// Bytes that the spill folder held before the passes removed what only they need.
  virtual uint64_t peak_spill_bytes() const = 0;
  /// Of each attribute of the source, where they are kept.
  virtual std::span<const io::AttributeRange> attribute_ranges() const = 0;
  /// Input vertex index -> (subtree, local); mapped, in the order of the file. None: reopened scan.
  virtual std::span<const VertexRef> vertex_map() const = 0;
};

/// Pass 0: bounding box. Failure kInput naming vertex and file where a coordinate is NaN or
/// infinite.
Bounds MeasureBounds(const io::MeshSource& source, parallel::Runner& runner,
                     parallel::Progress& progress);

/// Passes 1-3 of the design: voxel statistics (OpenVDB), Lloyd split of the weighted voxels with
/// the metric of section 2.1, scatter into chunks. The result depends on the scan and the settings
/// only: not on threads, not on `memory_bytes`, which bounds buffers and resident pages.
/// with_attributes: the chunks have those of the source.
std::unique_ptr<PartitionedScan> PartitionScan(const io::MeshSource& source, const Lattice& lattice,
                                               const PartitionSettings& settings,
                                               uint64_t memory_bytes, parallel::Runner& runner,
                                               const io::SpillDirectory& spill,
                                               parallel::Progress& progress,
                                               bool with_attributes = false);

/// A partition whose chunks lie in the kept spill of another process; they are not looked at here.
/// attribute_bytes: of a vertex, 0 where none are kept.
std::unique_ptr<PartitionedScan> ReopenScan(const io::SpillDirectory& spill,
                                            std::vector<SubtreeSummary> summaries,
                                            std::vector<io::AttributeRange> ranges, bool with_exact,
                                            size_t attribute_bytes, uint64_t peak_spill_bytes);

}  // namespace folprom
