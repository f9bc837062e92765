// Whether an operation has to run, and running it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "apps/batch/batch_report.h"
#include "apps/batch/ledger.h"
#include "apps/batch/plan.h"
#include "parallel/progress.h"

namespace folprom::batch {

/// What an operation is given of the budgets.
struct Share {
  uint32_t threads = 1;
  uint64_t memory_bytes = 0;
};

enum class Verdict : uint8_t {
  kUpToDate,
  kRun,
  kUnknown  ///< a file must be read first
};

struct Finding {
  Verdict verdict = Verdict::kUnknown;
  std::string reason;            ///< a few words
  std::optional<Record> record;  ///< of what is up to date, with the stamps of now
};

/// By what the ledger and the cache of hashes know, without reading a file.
Finding Look(const Plan& plan, const Task& task);
/// Reads files whose hash is not known: never kUnknown. Throws Failure kInput; Cancelled.
Finding Examine(Plan* plan, const Task& task, parallel::Progress& progress);

struct Outcome {
  OperationResult result;
  std::optional<Record> record;  ///< of what is done or up to date
};

/// Of a task that was found up to date.
Outcome UpToDate(const Plan& plan, const Task& task, const Finding& finding);
/// Examines, and runs where that says so. Faults become a result that failed.
Outcome RunTask(Plan* plan, const Task& task, const Share& share, parallel::Progress& progress);

}  // namespace folprom::batch
