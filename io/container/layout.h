// Where every segment and every checksum stands, from the sizes alone: the same on both sides.
#pragma once

#include <cstdint>
#include <vector>

#include "io/container/file_table.h"

namespace folprom::io {

/// A group of segments is closed as soon as it has this many bytes.
inline constexpr uint64_t kGroupBytes = 512;
inline constexpr uint64_t kGroupChecksumBytes = 4;

/// Consecutive bytes of segments of one layer; their checksum stands at `end`. Never empty.
struct ChecksumGroup {
  uint64_t begin = 0;
  uint64_t end = 0;
};

/// Byte positions in the file.
struct FileLayout {
  std::vector<uint64_t> segment_begin;  ///< index FileTable::SegmentIndex
  std::vector<ChecksumGroup> groups;    ///< in the order of the file
  std::vector<uint64_t> layer_end;      ///< after the checksum of the layer's last group
  uint64_t checksum_bytes = 0;          ///< of all groups
  uint64_t file_bytes = 0;
};

/// Takes as much memory for the places of the segments as the table for their sizes. `begin`: byte
/// after the header. The table has no fault, so no position overflows.
FileLayout LayoutOf(const FileTable& table, uint64_t begin);

}  // namespace folprom::io
