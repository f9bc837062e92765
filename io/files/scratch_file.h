// A file without a name for what an output needs only until it is complete.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "io/files/mapped_file.h"
#include "io/files/posix.h"

namespace folprom::io {

/// $TMPDIR or /tmp.
std::string TemporaryFolder();

/// Is gone with its object, however the program ends. All errors are Failure kOutput with `path`,
/// the output, or the input, for which it is made.
class ScratchFile {
 public:
  ScratchFile(const std::string& folder, std::string path);

  void Append(std::span<const uint8_t> bytes);
  uint64_t size() const { return size_; }
  /// All that was appended so far.
  MappedFile Map() const;
  /// Copies everything to `offset` of another open file.
  void CopyTo(int file, uint64_t offset, const std::string& path) const;

 private:
  std::string path_;
  Descriptor file_;
  uint64_t size_ = 0;
};

}  // namespace folprom::io
