// Gives the pages of a mapped file back behind a walk through it.
#pragma once

#include <cstdint>

#include "io/files/mapped_file.h"

namespace folprom::io {

/// Keeps the resident size of one walk, in ascending offsets, below about 32 MiB.
class ResidentWindow {
 public:
  explicit ResidentWindow(const MappedFile& file) : file_(file) {}

  /// The walk is at `offset` and does not go back.
  void Advance(uint64_t offset) {
    if (offset < dropped_ + kBytes) return;
    file_.DropResident(dropped_, offset);
    dropped_ = offset;
  }

 private:
  static constexpr uint64_t kBytes = uint64_t{32} << 20;
  const MappedFile& file_;
  uint64_t dropped_ = 0;  // offset up to which pages were given back
};

}  // namespace folprom::io
