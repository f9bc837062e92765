// A whole file as one read-only span of bytes.
#pragma once

#include <sys/stat.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "folprom/result.h"

namespace folprom::io {

/// Read-only private mapping. Movable. An empty file gives an empty span.
class MappedFile {
 public:
  /// kInput with path and reason: missing, a directory, not a regular file, not readable.
  static Result<MappedFile> Open(const std::string& path);
  /// The same of an open regular file; `path` is for messages.
  static Result<MappedFile> OfDescriptor(int file, const std::string& path);
  MappedFile() = default;
  MappedFile(MappedFile&& other) noexcept { swap(other); }
  MappedFile& operator=(MappedFile&& other) noexcept {
    swap(other);
    return *this;
  }
  ~MappedFile();

  std::span<const uint8_t> bytes() const { return {data_, size_}; }
  const std::string& path() const { return path_; }
  /// Failure kInput where the file has been written or cut since it was mapped. One that was
  /// replaced, or removed, is still what it was.
  void CheckUnchanged() const;
  /// Lets the resident pages of [begin, end) go; the next touch maps them again from the cache.
  void DropResident(size_t begin, size_t end) const;
  void DropResident() const { DropResident(0, size_); }

 private:
  void swap(MappedFile& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(path_, other.path_);
    std::swap(status_, other.status_);
  }
  const uint8_t* data_ = nullptr;
  size_t size_ = 0;
  std::string path_;
  struct stat status_ {};  ///< when it was mapped
};

}  // namespace folprom::io
