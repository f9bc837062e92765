// A temporary file of fixed-size records that blocks write at their own offsets.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "io/files/mapped_file.h"
#include "io/files/posix.h"
#include "io/spill/spill.h"

namespace folprom::partition {

/// Created empty in the spill folder, removed by Remove or with the folder. ReadAt and WriteAt are
/// thread-safe for ranges that do not overlap. All errors are Failure kOutput with path and reason.
class OffsetFile {
 public:
  OffsetFile(const io::SpillDirectory& directory, const std::string& name);
  void WriteAt(uint64_t offset, const void* bytes, size_t size);
  /// Fails where the file ends before offset + size.
  void ReadAt(uint64_t offset, void* bytes, size_t size) const;

  template <class T>
  void WriteRecords(uint64_t first, std::span<const T> records) {
    WriteAt(first * sizeof(T), records.data(), records.size_bytes());
  }
  template <class T>
  void ReadRecords(uint64_t first, std::span<T> records) const {
    ReadAt(first * sizeof(T), records.data(), records.size_bytes());
  }

  /// The bytes written so far.
  io::MappedFile Map() const;
  /// Gives the disk space back once no mapping is left.
  void Remove();

 private:
  std::string path_;
  io::Descriptor file_;
};

}  // namespace folprom::partition
