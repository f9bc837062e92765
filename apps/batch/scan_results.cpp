#include "apps/batch/scan_results.h"

#include <algorithm>
#include <map>
#include <utility>

namespace folprom::batch {

std::vector<ScanResults> ByScan(const BatchReport& report) {
  std::vector<ScanResults> scans;
  std::map<std::pair<std::string, std::string>, size_t> places;
  for (const OperationResult& result : report.results) {
    const auto [place, is_new] = places.try_emplace({result.job, result.scan}, scans.size());
    if (is_new) scans.push_back({result.job, result.scan, {}});
    scans[place->second].operations.push_back(&result);
  }
  return scans;
}

Status StatusOf(const ScanResults& scan) {
  for (const Status status :
       {Status::kFailed, Status::kInterrupted, Status::kNotRun, Status::kDone}) {
    for (const OperationResult* result : scan.operations) {
      if (result->status == status) return status;
    }
  }
  return Status::kUpToDate;
}

const OperationResult* Find(const ScanResults& scan, Operation operation) {
  const auto found =
      std::find_if(scan.operations.begin(), scan.operations.end(),
                   [&](const auto* result) { return result->operation == operation; });
  return found == scan.operations.end() ? nullptr : *found;
}

bool IsThere(const OperationResult& result) {
  return result.status == Status::kDone || result.status == Status::kUpToDate;
}

}  // namespace folprom::batch
