#include "io/container/layout.h"

namespace folprom::io {

void FileLayout::AddTable(uint64_t bytes) {
  end_ += bytes + kGroupChecksumBytes;
  table_bytes_ += bytes + kGroupChecksumBytes;
}

void FileLayout::AddSections(const FileTable& table) {
  for (size_t i = 0; i < kSectionKinds; ++i) {
    section_begin_[i] = end_;
    if (table.sections[i]) end_ += table.sections[i]->bytes;
  }
}

void FileLayout::CloseGroup(uint64_t begin) {
  groups_.push_back({begin, end_});
  end_ += kGroupChecksumBytes;
}

void FileLayout::AddLayers(const FileTable& table, size_t end) {
  segment_begin_.reserve(table.segment_bytes.size());
  const size_t segments_per_layer = table.subtrees.size() * 2;
  const uint64_t group_bytes = GroupBytes(table.subtrees.size());
  for (size_t layer = layer_end_.size(); layer < end; ++layer) {
    layer_begin_.push_back(end_);
    uint64_t group_begin = end_;
    for (size_t i = 0; i < segments_per_layer; ++i) {
      segment_begin_.push_back(end_);
      end_ += table.segment_bytes[layer * segments_per_layer + i];
      if (end_ - group_begin < group_bytes) continue;
      CloseGroup(group_begin);
      group_begin = end_;
    }
    if (end_ > group_begin) CloseGroup(group_begin);
    layer_end_.push_back(end_);
  }
}

}  // namespace folprom::io
