// Where every segment and every checksum stands, from the sizes alone: the same on both sides.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/container/file_table.h"

namespace folprom::io {

/// A group of segments is closed as soon as it has this many bytes: of a file of few subtrees, of
/// which each is a large part anyway, more than of one whose regions are read alone.
inline uint64_t GroupBytes(size_t subtrees) {
  constexpr uint64_t kLeast = 512, kOfAll = 32768;
  return std::max(kLeast, kOfAll / std::max<uint64_t>(subtrees, 1));
}
/// Of a group, and of a table between layers.
inline constexpr uint64_t kGroupChecksumBytes = 4;

/// Consecutive bytes of segments of one layer; their checksum stands at `end`. Never empty.
struct ChecksumGroup {
  uint64_t begin = 0;
  uint64_t end = 0;
};

/// Byte positions in the file, appended to as its tables become known. Takes as much memory for the
/// places of the segments as the table for their sizes.
class FileLayout {
 public:
  /// Behind the header.
  explicit FileLayout(uint64_t header_bytes = 0) : end_(header_bytes), table_bytes_(header_bytes) {}

  /// A table between layers.
  void AddTable(uint64_t bytes);
  /// The layers before `end` that the layout has not yet. The table has no fault, so no position
  /// overflows.
  void AddLayers(const FileTable& table, size_t end);

  /// Behind the last layer.
  void AddSections(const FileTable& table);

  /// Of each section, the first byte; of one that the file has not, where it would begin.
  const std::array<uint64_t, kSectionKinds>& section_begin() const { return section_begin_; }
  /// Index FileTable::SegmentIndex.
  const std::vector<uint64_t>& segment_begin() const { return segment_begin_; }
  /// In the order of the file.
  const std::vector<ChecksumGroup>& groups() const { return groups_; }
  /// Before the first group of each layer, and after the checksum of its last one.
  const std::vector<uint64_t>& layer_begin() const { return layer_begin_; }
  const std::vector<uint64_t>& layer_end() const { return layer_end_; }
  uint64_t checksum_bytes() const { return groups_.size() * kGroupChecksumBytes; }
  /// Header, and tables with their checksums.
  uint64_t table_bytes() const { return table_bytes_; }
  /// After all that was appended.
  uint64_t end() const { return end_; }

 private:
  void CloseGroup(uint64_t begin);

  std::vector<uint64_t> segment_begin_;
  std::vector<ChecksumGroup> groups_;
  std::vector<uint64_t> layer_begin_, layer_end_;
  std::array<uint64_t, kSectionKinds> section_begin_{};
  uint64_t end_, table_bytes_;
};

}  // namespace folprom::io
