// The record, in the spill folder of an encoding, of which of its work is done.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "engine/encode_state.h"
#include "folprom/settings.h"
#include "io/files/posix.h"
#include "io/spill/spill.h"

namespace folprom {

/// What must be the same for an encoding to go on from what another process left.
struct JobIdentity {
  uint64_t scan = 0;      ///< size, time of change, and bytes of the file here and there
  uint64_t settings = 0;  ///< all that decide bytes
  uint64_t program = 0;   ///< its version, and that of the file format
};
/// Throws Failure kInput where the scan cannot be read.
JobIdentity IdentityOf(const std::string& input, const EncodeOptions& options);

/// Name of the spill folder of this encoding, the same at each call.
std::string SpillName(const std::string& input, const std::string& output);

/// Work that an earlier process finished, as far as its records are whole. That the files beside
/// the journal are what it says is not checked here.
struct DoneWork {
  PartitionState partition;
  std::map<uint32_t, SubtreeOutcome> subtrees;
  std::map<uint32_t, SeamOutcome> seams;
};

/// Each record has its checksum, so one that a dying process or machine cut is told from a whole
/// one. Nothing is synced: what a crash of the machine loses is found by the checksums too. Add*
/// are thread-safe. Errors are Failure kOutput.
class EncodeJournal {
 public:
  explicit EncodeJournal(const io::SpillDirectory& spill);

  /// What an earlier process with the same identity left; new records go behind the last whole one.
  /// None where there is nothing to go on from; *why says why where there was a journal.
  std::optional<DoneWork> Recover(const JobIdentity& identity, std::string* why);
  /// Starts a journal in place of any other.
  void Begin(const JobIdentity& identity, const PartitionState& state);
  void Add(uint32_t subtree, const SubtreeOutcome& outcome);
  void Add(uint32_t owner, const SeamOutcome& outcome);

 private:
  void Append(const RecordWriter& record);

  std::string path_;
  io::Descriptor file_;
  std::mutex mutex_;
};

}  // namespace folprom
