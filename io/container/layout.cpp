#include "io/container/layout.h"

namespace folprom::io {

FileLayout LayoutOf(const FileTable& table, uint64_t begin) {
  FileLayout layout;
  layout.segment_begin.reserve(table.segment_bytes.size());
  layout.layer_end.reserve(table.layers.size());
  uint64_t at = begin, group_begin = begin;
  const auto close_group = [&] {
    layout.groups.push_back({group_begin, at});
    at += kGroupChecksumBytes;
    group_begin = at;
  };
  const size_t segments_per_layer = table.subtrees.size() * 2;
  for (size_t layer = 0; layer < table.layers.size(); ++layer) {
    for (size_t i = 0; i < segments_per_layer; ++i) {
      layout.segment_begin.push_back(at);
      at += table.segment_bytes[layer * segments_per_layer + i];
      if (at - group_begin >= kGroupBytes) close_group();
    }
    if (at > group_begin) close_group();
    layout.layer_end.push_back(at);
  }
  layout.checksum_bytes = layout.groups.size() * kGroupChecksumBytes;
  layout.file_bytes = at;
  return layout;
}

}  // namespace folprom::io
