// The stages of an encoding as one object per job; encode.cpp and verify.cpp call them in order.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/codec/encode_subtree.h"
#include "engine/codec/parameters.h"
#include "engine/mesh/lattice.h"
#include "engine/partition/offset_file.h"
#include "engine/partition/partition.h"
#include "folprom/folprom.h"
#include "io/container/file_table.h"
#include "io/files/atomic_file.h"
#include "io/formats/mesh_source.h"
#include "io/spill/spill.h"
#include "parallel/progress.h"
#include "parallel/runner.h"

namespace folprom {

/// Lattice and tolerance of a scan. Throws Failure kUsage where the tolerance is finer than the
/// lattice can be.
struct Resolution {
  Lattice lattice;
  double tolerance = 0;  ///< asked for, model units per axis
};
Resolution ResolutionOf(const Bounds& bounds, ScalarType type, const EncodeOptions& options);

/// Type in which decoded coordinates are written.
ScalarType OutputType(ScalarType input);

class EncodeJob {
 public:
  EncodeJob(const std::string& input, const EncodeOptions& options, parallel::Runner& runner,
            parallel::Progress& progress);

  void MeasureScan();
  /// The lattice of an existing file instead of the scan's own (verify).
  void UseResolution(const Resolution& resolution) { resolution_ = resolution; }
  void Partition();
  /// keep_order: keep the final index of each vertex for MapOrder. `stage`: name for the progress,
  /// a literal.
  void EncodeSubtrees(bool keep_order, const char* stage = "encode");
  /// Subtree by subtree, the index that each vertex gets in its subtree, as uint32_t.
  io::MappedFile MapOrder() const { return order_->Map(); }
  void EncodeSeams();
  io::FileTable MakeTable();
  uint64_t WriteFile(const io::FileTable& table, io::AtomicFile& out);

  /// After Partition; MakeTable drops the layers in which nothing was coded.
  const CodecParameters& parameters() const { return parameters_; }
  /// Of all subtrees and seams, after MakeTable.
  const CostMeters& costs() const { return costs_; }
  const io::MeshSource& source() const { return *source_; }
  const PartitionedScan& scan() const { return *scan_; }
  const io::SpillDirectory& spill() const { return *spill_; }
  /// Most bytes that the spill folder has held so far. Nothing is removed after the partition.
  uint64_t PeakSpillBytes() const {
    return std::max(spill_->SizeBytes(), scan_ ? scan_->peak_spill_bytes() : 0);
  }
  std::vector<std::string> Warnings() const;

 private:
  void MeasureExactScan();
  /// Are the attributes of vertices coded, if there are any.
  bool KeepsAttributes() const;
  std::vector<ValueSpan> SpansOfAttributes() const;
  /// What stays in memory of a subtree and its seam once their bits are spilled.
  struct Outcome {
    std::vector<uint32_t> inner_bytes, seam_bytes;  ///< per layer
    std::vector<double> distance;
    std::vector<uint32_t> vertices;
    std::vector<uint64_t> faces;
    std::vector<bool> active;
    io::MeshDigest digest;
    CostMeters meters;
  };
  /// Mean edge length of a sample of every subtree, lattice units; 0 without faces.
  double TypicalEdge() const;
  void DropEmptyLayers();
  std::vector<uint32_t> SeamMembers(size_t owner) const;

  EncodeOptions options_;
  parallel::Runner& runner_;
  parallel::Progress& progress_;
  std::unique_ptr<io::MeshSource> source_;
  std::unique_ptr<io::SpillDirectory> spill_;
  Resolution resolution_;
  CodecParameters parameters_;
  std::unique_ptr<PartitionedScan> scan_;
  std::vector<Outcome> outcomes_;
  std::optional<partition::OffsetFile> order_;
  CostMeters costs_;
  std::vector<uint32_t> kept_layers_;
};

}  // namespace folprom
