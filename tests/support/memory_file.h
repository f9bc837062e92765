// An output file in memory.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "folprom/result.h"
#include "io/container/writer.h"
#include "io/files/atomic_file.h"

namespace folprom::support {

/// Keeps what is appended; fails once that would be more than `room` bytes.
class MemoryFile final : public io::AtomicFile {
 public:
  explicit MemoryFile(size_t room = SIZE_MAX) : room_(room) {}
  Result<void> Append(std::span<const uint8_t> bytes) override {
    if (bytes_.size() + bytes.size() > room_) return Error{ErrorKind::kOutput, "disk full"};
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    ++appends_;
    return {};
  }
  Result<void> WriteAt(uint64_t, std::span<const uint8_t>) override {
    return Error{ErrorKind::kInternal, "not used"};
  }
  Result<void> AppendFrom(const io::ScratchFile&) override {
    return Error{ErrorKind::kInternal, "not used"};
  }
  const std::string& folder() const override { return folder_; }
  Result<void> Commit() override { return Error{ErrorKind::kInternal, "not the writer's to call"}; }

  const std::vector<uint8_t>& bytes() const { return bytes_; }
  size_t appends() const { return appends_; }

 private:
  size_t room_;
  size_t appends_ = 0;
  std::vector<uint8_t> bytes_;
  std::string folder_;
};

/// The bytes of a .folp file of this table and these segments.
inline std::vector<uint8_t> WrittenContainer(const io::FileTable& table,
                                             const io::SegmentBytes& segment) {
  MemoryFile file;
  io::WriteContainer(table, segment, file);
  return file.bytes();
}

}  // namespace folprom::support
