// Threads and memory that operations at the same time share.
#pragma once

#include <cstdint>
#include <optional>

#include "apps/batch/plan.h"
#include "apps/batch/task.h"

namespace folprom::batch {

/// What an operation can use, by the size of its scan.
struct Need {
  uint32_t threads = 1;       ///< one a subtree: more would wait
  uint64_t memory_bytes = 0;  ///< resident, of that many threads
};

/// An estimate from the size of the file alone. `threads` is the most that there are.
Need NeedOf(const Plan& plan, const Task& task, uint32_t threads);

/// Hands out shares: as many threads as needed, and of the memory the same part, or what is needed
/// where that is more. The shares that are out never exceed the budget, unless it is one alone.
class Budget {
 public:
  Budget(uint32_t threads, uint64_t memory_bytes)
      : threads_(threads), memory_bytes_(memory_bytes) {}

  /// None where it does not fit beside what is out.
  std::optional<Share> Take(const Need& need);
  void GiveBack(const Share& share);
  uint32_t threads() const { return threads_; }

 private:
  const uint32_t threads_;
  const uint64_t memory_bytes_;
  uint32_t threads_out_ = 0;
  uint64_t memory_out_ = 0;
};

}  // namespace folprom::batch
