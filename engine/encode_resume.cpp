// How an encoding goes on from what an interrupted one left.
#include <algorithm>
#include <atomic>
#include <utility>

#include "engine/codec/border_file.h"
#include "engine/encode_job.h"
#include "engine/kept_attributes.h"
#include "io/container/checksum.h"

namespace folprom {
namespace {

bool IsFileIntact(const io::SpillDirectory& spill, const std::string& name, uint64_t hash) {
  auto file = io::MappedFile::Open(spill.File(name));
  return file && io::XxHash64(file->bytes()) == hash;
}

}  // namespace

bool EncodeJob::Resume(const std::string& output, folprom::Resume resume) {
  auto named =
      io::SpillDirectory::OpenNamed(options_.temporary_folder, SpillName(source_->path(), output));
  if (!named) return false;  // the same encoding runs at this moment: this one goes its own way
  spill_ = std::move(named);
  identity_ = IdentityOf(source_->path(), options_);
  journal_.emplace(*spill_);
  std::string why;
  if (resume != folprom::Resume::kRestart) {
    if (auto work = journal_->Recover(identity_, &why)) {
      if (Recover(std::move(*work))) return true;
      why = "they are damaged";
    }
  }
  if (!why.empty()) {
    resume_note_ =
        spill_->path() + ": temporary files of an interrupted encoding were not used: " + why;
  }
  scan_.reset();
  outcomes_.clear();
  spill_->Clear();
  return false;
}

bool EncodeJob::Recover(DoneWork work) {
  PartitionState& state = work.partition;
  resolution_ = state.resolution;
  const size_t stride = KeepsAttributes(options_) ? source_->vertex_schema().Stride() : 0;
  const bool with_exact = resolution_.lattice.exact && resolution_.lattice.exact->step.has_rests;
  scan_ = ReopenScan(*spill_, std::move(state.summaries), std::move(state.ranges), with_exact,
                     stride, state.peak_spill_bytes);
  outcomes_.resize(scan_->subtree_count());
  SetParameters(state.typical_edge);
  for (auto& [subtree, outcome] : work.subtrees) {
    outcomes_[subtree].inner = std::move(outcome);
    outcomes_[subtree].has_inner = true;
  }
  for (auto& [owner, outcome] : work.seams) {
    outcomes_[owner].seam = std::move(outcome);
    outcomes_[owner].has_seam = true;
  }
  if (!CheckSpilled(state.hashes)) return false;
  has_journal_ = true;
  resumed_subtrees_ = static_cast<uint64_t>(
      std::count_if(outcomes_.begin(), outcomes_.end(),
                    [](const Outcome& outcome) { return outcome.has_inner; }));
  return true;
}

bool EncodeJob::CheckSpilled(const std::vector<ChunkHashes>& expected) {
  if (expected.size() != outcomes_.size()) return false;
  progress_.StartStage("check", outcomes_.size());
  std::atomic<bool> intact{true};
  runner_.ForEach(outcomes_.size(), [&](size_t s) {
    Outcome& outcome = outcomes_[s];
    const SubtreeOutcome& inner = outcome.inner;
    const uint32_t number = static_cast<uint32_t>(s);
    outcome.has_inner &= IsFileIntact(*spill_, InnerName(s), inner.inner_hash) &&
                         (scan_->summary(s).neighbours.empty() ||
                          IsFileIntact(*spill_, BorderName(number), inner.border_hash));
    outcome.has_seam &= IsFileIntact(*spill_, SeamName(s), outcome.seam.hash);
    const bool needs_seam = !outcome.has_seam && !SeamMembers(s).empty();
    if ((!outcome.has_inner || needs_seam) && !IsChunkIntact(s, expected[s])) intact = false;
    progress_.Advance(1);
  });
  return intact;
}

bool EncodeJob::IsChunkIntact(size_t subtree, const ChunkHashes& expected) const {
  try {
    return HashesOf(scan_->Load(subtree)) == expected;
  } catch (const Failure&) {
    return false;
  }
}

void EncodeJob::BeginJournal(double typical_edge) {
  PartitionState state;
  state.resolution = resolution_;
  state.typical_edge = typical_edge;
  state.peak_spill_bytes = scan_->peak_spill_bytes();
  state.ranges.assign(scan_->attribute_ranges().begin(), scan_->attribute_ranges().end());
  state.hashes.resize(outcomes_.size());
  for (size_t s = 0; s < outcomes_.size(); ++s) state.summaries.push_back(scan_->summary(s));
  runner_.ForEach(outcomes_.size(), [&](size_t s) {
    progress_.ThrowIfCancelled();
    state.hashes[s] = HashesOf(scan_->Load(s));
  });
  journal_->Begin(identity_, state);
  has_journal_ = true;
}

std::string EncodeJob::KeepSpill() {
  if (!has_journal_) return {};
  spill_->Keep();
  return spill_->path();
}

}  // namespace folprom
