// Runs the operations of a plan, several at once, and tells how each ended.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/batch/budget.h"
#include "apps/batch/plan.h"
#include "apps/folprom/progress_text.h"

namespace folprom::batch {

/// How far a batch is.
struct BatchReading {
  struct Running {
    std::string job;
    std::string scan;
    Operation operation = Operation::kEncode;
    cli::ProgressReading progress;
  };

  uint64_t scans = 0;
  uint64_t scans_done = 0;
  uint64_t scans_failed = 0;
  double fraction = 0;  ///< of the bytes that operations have to read, 0 .. 1
  double seconds = 0;
  double seconds_left = 0;  ///< 0: not known yet
  double vertices_per_second = 0;
  uint64_t memory_bytes = 0;  ///< resident, of all processes
  std::vector<Running> running;
};

/// Hears of a batch while it runs.
class Observer {
 public:
  virtual ~Observer() = default;
  /// Each operation once, in the order in which they end.
  virtual void Ended(const OperationResult& result) = 0;
  /// Several times a second.
  virtual void Tick(const BatchReading& reading) = 0;
};

/// One result for each task of the plan, in its order. `cancel` stops it, also from a signal. The
/// caller must have no other threads. Throws Failure where the batch itself cannot go on: its state
/// file cannot be written, or there are no processes.
std::vector<OperationResult> RunPlan(Plan* plan, Budget budget, const parallel::Progress& cancel,
                                     Observer& observer);

/// Scans all of whose operations are done or up to date, and scans with one that failed.
struct ScanCounts {
  uint64_t done = 0;
  uint64_t failed = 0;
};
ScanCounts CountScans(const Plan& plan, const std::vector<OperationResult>& results);

}  // namespace folprom::batch
