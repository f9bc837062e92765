// Tables and files that the container's tests share, made from seeds.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "io/container/file_table.h"
#include "io/container/writer.h"

namespace folprom::io {

/// A valid table of random numbers; few_bytes keeps every segment below 1,500 bytes.
FileTable RandomTable(uint64_t seed, bool few_bytes);

/// 8 subtrees, 30 layers whose segments grow geometrically to 12,000 bytes (seams to 900) with 15 %
/// of spread: a file of 1 MB, as a scan of 440,000 vertices gives.
FileTable ScanLikeTable();

/// The table of the example in FORMAT.md.
FileTable ExampleTable();

/// Bytes of a segment that depend on its name only, as many as the table says.
std::vector<uint8_t> SampleSegment(const FileTable& table, size_t layer, size_t subtree,
                                   SegmentPart part);

/// A whole file with sample segments.
std::vector<uint8_t> SampleFile(const FileTable& table);

/// Calls use(layer, subtree, part) for each segment in the order of the file.
template <class Use>
void ForEachSegment(const FileTable& table, const Use& use) {
  for (size_t layer = 0; layer < table.layers.size(); ++layer) {
    for (size_t subtree = 0; subtree < table.subtrees.size(); ++subtree) {
      for (const SegmentPart part : {SegmentPart::kInner, SegmentPart::kSeam}) {
        use(layer, subtree, part);
      }
    }
  }
}

}  // namespace folprom::io
