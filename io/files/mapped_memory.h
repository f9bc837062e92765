// A file as memory to read and write: what may be larger than the memory that a job may take.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

namespace folprom::io {

/// A new file of zeros, mapped. Its disk space is taken at once, so that no later write can fail.
/// Movable. The file stays where it is.
class MappedMemory {
 public:
  /// Throws Failure kOutput with path and reason: it is there already, the disk is full, ...
  MappedMemory(const std::string& path, size_t bytes);
  MappedMemory(MappedMemory&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}
  MappedMemory& operator=(MappedMemory&&) = delete;
  ~MappedMemory();

  std::span<uint8_t> bytes() const { return {data_, size_}; }
  /// Lets the resident pages go; what was written stays.
  void DropResident() const;

 private:
  uint8_t* data_ = nullptr;
  size_t size_ = 0;
};

}  // namespace folprom::io
