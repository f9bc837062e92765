// The state file of an output folder: what was made in it, from what and how.
#pragma once

#include <sys/types.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "apps/batch/batch_report.h"
#include "apps/batch/file_stamp.h"
#include "io/files/posix.h"

namespace folprom::batch {

/// A finished operation.
struct Record {
  std::string version;   ///< of program and format
  std::string settings;  ///< hash of all that decides the output beside its inputs
  std::vector<KnownFile> inputs;
  std::vector<KnownFile> outputs;
  OperationResult result;
};

Json ToJson(const Record& record);
Result<Record> RecordFromJson(const Json& json);

/// Name of the state file, in the output folder. Lines of JSON: {"begin": KEY, "process": ID} when
/// an operation begins, {"done": KEY, "record": {...}} when it is done; the last of a key counts. A
/// record holds until the next: where a run ended in between, the outputs differ from it. A line
/// that a crash cut is left out.
inline constexpr const char* kLedgerName = ".folprom-batch";

/// The state file of one folder. A key names an operation: its kind and its output.
class Ledger {
 public:
  /// Reads the file, if there is one. Throws Failure kInput where it cannot be read.
  explicit Ledger(const std::string& folder);

  /// None where the operation was never done to its end.
  const Record* Find(const std::string& key) const;
  /// The operation was begun at least, so that what stands in its place is this batch's.
  bool Knows(const std::string& key) const;
  void RememberHashes(HashCache* cache) const;

  /// Opens for writing: waits a little for another batch in the folder to end, removes what killed
  /// processes left half written, and drops lines that no longer count. Throws Failure kOutput.
  void Open();
  void Begin(const std::string& key, pid_t process);
  void Done(const std::string& key, const Record& record);

 private:
  void ReadLines();
  void Lock();
  void RemoveLeftovers() const;
  std::string PathOf() const { return folder_ + "/" + kLedgerName; }
  void Append(const Json& line);

  std::string folder_;
  std::map<std::string, Record> done_;
  std::map<std::string, pid_t> begun_;
  io::Descriptor lock_;
  io::Descriptor file_;
};

}  // namespace folprom::batch
