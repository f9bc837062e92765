// An output file that appears complete or not at all.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "folprom/result.h"
#include "io/files/scratch_file.h"

namespace folprom::io {

/// Writes to a hidden temporary file beside the target; Commit syncs it, renames it over the target
/// and syncs the folder. Destroyed before Commit, it removes the temporary file and leaves the old
/// output as it was. All errors are kOutput and name path and reason.
class AtomicFile {
 public:
  /// Fails when the target exists and `force` is false, is a directory or a symbolic link to
  /// nothing, or its folder is missing or not writable.
  static Result<std::unique_ptr<AtomicFile>> Create(const std::string& path, bool force);
  virtual ~AtomicFile() = default;
  /// Appends at the end of what was appended so far.
  virtual Result<void> Append(std::span<const uint8_t> bytes) = 0;
  /// Writes at an absolute offset; does not move the append position.
  virtual Result<void> WriteAt(uint64_t offset, std::span<const uint8_t> bytes) = 0;
  /// Appends all of a scratch file, by the file system where it can.
  virtual Result<void> AppendFrom(const ScratchFile& scratch) = 0;
  /// Where the file will be, and where there is room for scratch files.
  virtual const std::string& folder() const = 0;
  virtual Result<void> Commit() = 0;
};

/// A small file at once.
Result<void> WriteWholeFile(const std::string& path, std::string_view text, bool force);

}  // namespace folprom::io
