// The subtrees and seams of an encoding, in parallel; their bits go to the spill folder.
#include <algorithm>

#include "engine/codec/border_file.h"
#include "engine/encode_job.h"
#include "io/container/checksum.h"
#include "parallel/memory_budget.h"

namespace folprom {
namespace {

/// Returns the size of each; *hash: of the file.
std::vector<uint32_t> SpillSegments(const io::SpillDirectory& spill, const std::string& name,
                                    const std::vector<std::vector<uint8_t>>& segments,
                                    uint64_t* hash) {
  std::vector<uint8_t> joined;
  std::vector<uint32_t> sizes;
  for (const auto& segment : segments) {
    joined.insert(joined.end(), segment.begin(), segment.end());
    sizes.push_back(static_cast<uint32_t>(segment.size()));
  }
  io::WriteSpillFile(spill, name, joined);
  *hash = io::XxHash64(joined);
  return sizes;
}

}  // namespace

void EncodeJob::EncodeSubtrees(bool keep_order, const char* stage) {
  std::vector<size_t> order;
  uint64_t done = 0;
  first_vertex_.assign(1, 0);
  for (size_t s = 0; s < outcomes_.size(); ++s) {
    const uint32_t vertices = scan_->summary(s).vertices;
    first_vertex_.push_back(first_vertex_.back() + vertices);
    if (outcomes_[s].has_inner) {
      done += vertices;
    } else {
      order.push_back(s);
    }
  }
  // The largest first: the last tasks to end are then small. Results do not depend on it.
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return scan_->summary(a).vertices > scan_->summary(b).vertices;
  });
  if (keep_order) order_.emplace(*spill_, "order");
  if (Sections().any()) curve_.emplace(*spill_, "curve");
  progress_.StartStage(stage, source_->vertex_count(), "vertices");
  progress_.Advance(done);
  parallel::MemoryBudget budget(WorkingBytes() * 3 / 4);
  runner_.ForEach(order.size(), [&](size_t i) {
    const SubtreeSummary& summary = scan_->summary(order[i]);
    auto lease = budget.Acquire(EncodeSubtreeBytes(summary, parameters_));
    progress_.ThrowIfCancelled();  // behind the wait: the job may have been cancelled meanwhile
    EncodeOne(order[i], keep_order);
  });
}

void EncodeJob::EncodeOne(size_t subtree, bool keep_order) {
  const SubtreeSummary& summary = scan_->summary(subtree);
  const auto number = static_cast<uint32_t>(subtree);
  SubtreeChunk chunk = scan_->Load(subtree);
  size_t seen = 0;
  // Layer by layer, for a subtree takes seconds.
  const auto advance = [&](const SubtreeCoder& coder) {
    progress_.Advance(coder.positions().size() - seen);
    seen = coder.positions().size();
  };
  EncodedSubtree encoded = EncodeSubtree(chunk, summary, number, parameters_, {}, advance);
  SubtreeOutcome& outcome = outcomes_[subtree].inner;
  outcome.inner_bytes =
      SpillSegments(*spill_, InnerName(subtree), encoded.segments, &outcome.inner_hash);
  outcome.distance = std::move(encoded.distance);
  outcome.vertices = std::move(encoded.vertices);
  outcome.faces = std::move(encoded.faces);
  outcome.active = std::move(encoded.active);
  outcome.digest = encoded.digest;
  outcome.meters = encoded.meters;
  if (!summary.neighbours.empty()) {
    outcome.border_hash = SpillBorder(*spill_, number, encoded.border, encoded.border_vertices);
  }
  if (keep_order) {
    order_->WriteRecords<uint32_t>(first_vertex_[subtree], encoded.final_vertices);
  }
  if (curve_) {
    curve_->WriteRecords<uint32_t>(first_vertex_[subtree],
                                   CurvePlaces(chunk.positions, encoded.final_vertices));
  }
  if (journal_) journal_->Add(number, outcome);
  outcomes_[subtree].has_inner = true;
}

std::vector<uint32_t> EncodeJob::SeamMembers(size_t owner) const {
  std::vector<uint32_t> members;
  for (uint32_t neighbour : scan_->summary(owner).neighbours) {
    if (neighbour < owner) members.push_back(neighbour);
  }
  return members;
}

void EncodeJob::EncodeSeams() {
  progress_.StartStage("seams", outcomes_.size());
  parallel::MemoryBudget budget(WorkingBytes() * 3 / 4);
  runner_.ForEach(outcomes_.size(), [&](size_t owner) {
    if (!outcomes_[owner].has_seam && !SeamMembers(owner).empty()) {
      std::vector<uint32_t> members = SeamMembers(owner);
      members.push_back(static_cast<uint32_t>(owner));
      auto lease = budget.Acquire(
          EncodeSeamBytes(BorderBytes(*spill_, members), scan_->summary(owner).cross_faces));
      progress_.ThrowIfCancelled();
      EncodeOneSeam(owner, members);
    }
    progress_.Advance(1);
  });
}

void EncodeJob::EncodeOneSeam(size_t owner, const std::vector<uint32_t>& members) {
  std::vector<BorderFile> borders;
  for (uint32_t member : members) borders.push_back(LoadBorder(*spill_, member));
  SubtreeChunk chunk = scan_->Load(owner);
  EncodedSeam encoded = EncodeSeam(members, borders, chunk.cross_faces, parameters_);
  SeamOutcome& outcome = outcomes_[owner].seam;
  outcome.bytes = SpillSegments(*spill_, SeamName(owner), encoded.segments, &outcome.hash);
  outcome.faces = std::move(encoded.faces);
  outcome.active = std::move(encoded.active);
  outcome.face_digest = encoded.digest.faces;
  outcome.meter = encoded.meter;
  if (journal_) journal_->Add(static_cast<uint32_t>(owner), outcome);
  outcomes_[owner].has_seam = true;
}

}  // namespace folprom
