// The results of a batch, scan by scan.
#pragma once

#include <string>
#include <vector>

#include "apps/batch/batch_report.h"

namespace folprom::batch {

/// What was done with one scan of one job. Refers to the report.
struct ScanResults {
  std::string job;
  std::string scan;
  std::vector<const OperationResult*> operations;  ///< at least one, in the order of the report
};

/// In the order of the report.
std::vector<ScanResults> ByScan(const BatchReport& report);

/// The worst of its operations: failed, then interrupted, then not run; up to date where all are.
Status StatusOf(const ScanResults& scan);

/// The first one of this kind, or null.
const OperationResult* Find(const ScanResults& scan, Operation operation);

/// Its outcome, or that of an earlier run, is there.
bool IsThere(const OperationResult& result);

}  // namespace folprom::batch
