#include "apps/batch/budget.h"

#include <algorithm>

namespace folprom::batch {
namespace {

// Measured on scans of 6,000 to 1,500,000 vertices; rounded up.
constexpr uint64_t kProgramBytes = uint64_t{48} << 20;
constexpr uint64_t kEncodeBytesPerVertex = 720;  // of the subtrees that are in work
constexpr uint64_t kDecodeBytesPerVertex = 320;
constexpr uint64_t kRdBytesPerVertex =
    1200;  // of the whole scan: two meshes and their search trees

// A binary PLY has 12 bytes a vertex and 13 a face, of which there are two a vertex.
constexpr uint64_t kScanBytesPerVertex = 38;
// About 12 bits a vertex.
constexpr uint64_t kFolpVerticesPer3Bytes = 2;

uint64_t VerticesOf(const Plan& plan, const Task& task) {
  const uint64_t bytes = plan.scans[task.scan].bytes;
  return plan.JobOf(task).from_folp() ? bytes * kFolpVerticesPer3Bytes / 3
                                      : bytes / kScanBytesPerVertex;
}

}  // namespace

Need NeedOf(const Plan& plan, const Task& task, uint32_t threads) {
  const uint64_t vertices = VerticesOf(plan, task);
  const uint64_t subtree = plan.JobOf(task).encode.options.codec.subtree_vertices;
  const uint64_t subtrees = std::max<uint64_t>((vertices + subtree - 1) / subtree, 1);
  Need need;
  need.threads = static_cast<uint32_t>(std::min<uint64_t>(subtrees, threads));
  const uint64_t in_work = std::min(need.threads * subtree, vertices);
  const bool decodes = task.operation == Operation::kDecode;
  need.memory_bytes =
      kProgramBytes + in_work * (decodes ? kDecodeBytesPerVertex : kEncodeBytesPerVertex);
  if (task.operation == Operation::kRd) need.memory_bytes += vertices * kRdBytesPerVertex;
  return need;
}

std::optional<Share> Budget::Take(const Need& need) {
  Share share;
  share.threads = std::min(std::max(need.threads, 1U), threads_);
  const uint64_t part = memory_bytes_ / threads_ * share.threads;
  share.memory_bytes = std::min(std::max(part, need.memory_bytes), memory_bytes_);
  const bool fits =
      share.threads <= threads_ - threads_out_ && share.memory_bytes <= memory_bytes_ - memory_out_;
  if (!fits) return std::nullopt;
  threads_out_ += share.threads;
  memory_out_ += share.memory_bytes;
  return share;
}

void Budget::GiveBack(const Share& share) {
  threads_out_ -= share.threads;
  memory_out_ -= share.memory_bytes;
}

}  // namespace folprom::batch
