// The stages of an encoding as one object per job; encode.cpp and verify_scan call them in order.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/codec/encode_subtree.h"
#include "engine/codec/parameters.h"
#include "engine/encode_journal.h"
#include "engine/encode_state.h"
#include "engine/partition/offset_file.h"
#include "engine/partition/partition.h"
#include "engine/resolution.h"
#include "engine/section_encoder.h"
#include "engine/weld/welded_source.h"
#include "folprom/folprom.h"
#include "io/container/file_table.h"
#include "io/files/atomic_file.h"
#include "io/formats/mesh_source.h"
#include "io/spill/spill.h"
#include "parallel/progress.h"
#include "parallel/runner.h"

namespace folprom {

/// Names of the spilled segments of a subtree.
inline std::string InnerName(size_t subtree) { return "inner." + std::to_string(subtree); }
inline std::string SeamName(size_t subtree) { return "seam." + std::to_string(subtree); }

class EncodeJob {
 public:
  EncodeJob(const std::string& input, const EncodeOptions& options, parallel::Runner& runner,
            parallel::Progress& progress);

  /// First of all: a soup, or where it is asked for any scan, is welded, and that is what the other
  /// stages see. Failure kOutput where the disk has no room for it. spill_name: of its temporary
  /// files, which the same job clears away should this one be killed; may be empty.
  void Weld(const io::AtomicFile& out, const std::string& spill_name);
  /// Welds, whatever the options are. spill: empty.
  void WeldScan(std::unique_ptr<io::SpillDirectory> spill);
  /// Takes over what an interrupted job from the same scan to `output` left, and from now on keeps
  /// what a later one needs. False where there is nothing to take over, or nothing that can be
  /// trusted: the scan is then to be measured and partitioned.
  bool Resume(const std::string& output, folprom::Resume resume);
  /// Failure kOutput where the disks have no room for the spill and for `out`.
  void CheckRoom(const io::AtomicFile& out);
  void MeasureScan();
  /// The lattice of an existing file instead of the scan's own (verify).
  void UseResolution(const Resolution& resolution) { resolution_ = resolution; }
  void Partition();
  /// keep_order: keep the final index of each vertex for MapOrder. `stage`: name for the progress,
  /// a literal.
  void EncodeSubtrees(bool keep_order, const char* stage = "encode");
  /// Subtree by subtree, the index that each vertex gets in its subtree, as uint32_t.
  io::MappedFile MapOrder() const { return order_->Map(); }
  /// The same of their places along the curve of the subtree; where the scan has sections.
  io::MappedFile MapCurve() const { return curve_->Map(); }
  void EncodeSeams();
  /// What the scan's own order and faces need, if they are kept.
  void EncodeSections();
  /// Are there any; known from the beginning.
  bool HasSections() const { return Sections().any(); }
  io::FileTable MakeTable();
  uint64_t WriteFile(const io::FileTable& table, io::AtomicFile& out);

  /// After Partition; MakeTable drops the layers in which nothing was coded.
  const CodecParameters& parameters() const { return parameters_; }
  /// Of all subtrees and seams, after MakeTable.
  const CostMeters& costs() const { return costs_; }
  const io::MeshSource& source() const { return *source_; }
  /// Null where it was not welded.
  const WeldedSource* welded() const { return welded_; }
  /// As the file has it.
  const io::MeshSource& original() const { return welded_ != nullptr ? welded_->scan() : *source_; }
  const PartitionedScan& scan() const { return *scan_; }
  /// That of Resume, or else one without a name. Made when it is asked for: a job that was killed
  /// before it found its own would leave it for good.
  const io::SpillDirectory& spill();
  /// Most bytes that the spill folder has held so far. Nothing is removed after the partition.
  uint64_t PeakSpillBytes() const {
    const uint64_t own = std::max(spill_->SizeBytes(), scan_ ? scan_->peak_spill_bytes() : 0);
    if (welded_ == nullptr) return own;
    return std::max(welded_->peak_spill_bytes(), welded_->spill_bytes() + own);
  }
  /// Leaves the spill to a later job, where that can go on from it. Returns its path, else nothing.
  std::string KeepSpill();
  uint64_t resumed_subtrees() const { return resumed_subtrees_; }
  std::vector<std::string> Warnings() const;

 private:
  void MeasureExactScan();
  std::vector<ValueSpan> SpansOfAttributes() const;
  SectionChoice Sections() const;
  /// What stays in memory of a subtree and its seam once their bits are spilled.
  struct Outcome {
    SubtreeOutcome inner;
    SeamOutcome seam;  ///< no bytes: it has none
    bool has_inner = false, has_seam = false;

    bool IsActive(uint32_t layer) const {
      return inner.active[layer] || (!seam.active.empty() && seam.active[layer]);
    }
  };
  /// Of the memory limit, what the stages may use.
  uint64_t WorkingBytes() const;
  void EncodeOne(size_t subtree, bool keep_order);
  void EncodeOneSeam(size_t owner, const std::vector<uint32_t>& members);
  /// Everything but the vertices that the partition decides.
  void SetParameters(double typical_edge);
  void BeginJournal(double typical_edge);
  /// Forgets work whose spilled files are not what they were; false where the partition's are not.
  bool CheckSpilled(const std::vector<ChunkHashes>& expected);
  bool IsChunkIntact(size_t subtree, const ChunkHashes& expected) const;
  bool Recover(DoneWork work);
  /// Mean edge length of a sample of every subtree, lattice units; 0 without faces.
  double TypicalEdge() const;
  void DropEmptyLayers();
  // Parts of the table.
  void DescribeScan(io::FileTable* table) const;
  void AddSubtrees(io::FileTable* table);
  void AddCosts(io::FileTable* table) const;
  void AddLayer(uint32_t layer, io::FileTable* table) const;
  std::vector<uint32_t> SeamMembers(size_t owner) const;

  EncodeOptions options_;
  parallel::Runner& runner_;
  parallel::Progress& progress_;
  std::unique_ptr<io::MeshSource> source_;
  const WeldedSource* welded_ = nullptr;  ///< source_, where it is one
  bool is_soup_ = false;                  ///< what it was welded from comes back
  std::unique_ptr<io::SpillDirectory> spill_;
  JobIdentity identity_;
  std::optional<EncodeJournal> journal_;  ///< of a job that may be continued
  bool has_journal_ = false;              ///< the partition and its record are complete
  std::string resume_note_;               ///< why an earlier job's files are not used
  uint64_t resumed_subtrees_ = 0;
  Resolution resolution_;
  CodecParameters parameters_;
  std::vector<io::AttributeRange> rounded_;  ///< of the attributes that are; see RoundedSource
  std::vector<std::string> rounding_warnings_;
  std::unique_ptr<PartitionedScan> scan_;
  std::vector<Outcome> outcomes_;
  std::vector<uint64_t> first_vertex_;  ///< of each subtree
  std::optional<partition::OffsetFile> order_, curve_;
  EncodedSections sections_;
  CostMeters costs_;
  std::vector<uint32_t> kept_layers_;
};

}  // namespace folprom
