// What a job file comes to: every scan with its operations, checked before any work.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "apps/batch/batch_report.h"
#include "apps/batch/file_stamp.h"
#include "apps/batch/job_file.h"
#include "apps/batch/ledger.h"

namespace folprom::batch {

/// One operation on one scan.
struct Task {
  Operation operation = Operation::kEncode;
  size_t scan = 0;                   ///< in Plan::scans
  Lod lod;                           ///< decode
  std::vector<std::string> inputs;   ///< whose content decides the outputs
  std::vector<std::string> outputs;  ///< the first one is that of the report
  std::string key;                   ///< in the ledger of the job's output folder
  std::string settings;              ///< hash of all else that decides the outputs
};

struct Scan {
  size_t job = 0;      ///< in JobFile::jobs
  std::string name;    ///< below the fixed part of all patterns of the job
  std::string input;   ///< absolute
  std::string folp;    ///< absolute; empty where the job has no encoded file
  uint64_t bytes = 0;  ///< of the input
  std::vector<size_t> tasks;
};

struct Plan {
  JobFile file;
  std::vector<Scan> scans;  ///< in the order of the job file
  std::vector<Task> tasks;  ///< scan by scan
  std::map<std::string, Ledger> ledgers;
  HashCache hashes;

  const Job& JobOf(const Task& task) const { return file.jobs[scans[task.scan].job]; }
  Ledger& LedgerOf(const Task& task) { return ledgers.at(OutputFolder(JobOf(task))); }
  /// Absolute, without links in the part that exists.
  std::string OutputFolder(const Job& job) const;
  /// Absolute path of the outputs of a scan without extension, were `pattern` that of its job.
  std::string StemOf(const Scan& scan, const std::string& pattern) const;
  /// With all that is known before the operation runs.
  OperationResult ResultOf(const Task& task) const;
};

/// Finds the scans and checks all that can be checked without reading them; writes nothing. Throws
/// Failure: kUsage, kInput (nothing matches, not readable), kOutput (not writable, or stands
/// already).
Plan MakePlan(JobFile file);

/// Makes the output folders and opens the ledgers. Throws Failure kOutput.
void OpenOutputs(Plan* plan);

/// "folprom 0.1.0, format 1": what made an output.
std::string VersionText();

}  // namespace folprom::batch
