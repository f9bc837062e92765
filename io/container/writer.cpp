#include "io/container/writer.h"

#include <string>
#include <vector>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "io/container/byte_code.h"
#include "io/container/header.h"
#include "io/container/layout.h"
#include "io/container/table_code.h"

namespace folprom::io {
namespace {

constexpr size_t kBufferBytes = 256 * 1024;

/// Gathers small pieces, since most segments are far smaller than what a file likes to be given.
class BufferedFile {
 public:
  explicit BufferedFile(AtomicFile* file) : file_(file) { buffer_.reserve(kBufferBytes); }

  void Append(std::span<const uint8_t> bytes) {
    if (buffer_.size() + bytes.size() > kBufferBytes) Flush();
    if (bytes.size() > kBufferBytes) {
      file_->Append(bytes).value();
    } else {
      buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
    }
  }
  void Flush() {
    if (!buffer_.empty()) file_->Append(buffer_).value();
    buffer_.clear();
  }

 private:
  AtomicFile* file_;
  std::vector<uint8_t> buffer_;
};

/// XXH3 over a group whose bytes come segment by segment.
class GroupHash {
 public:
  GroupHash() { XXH3_64bits_reset(&state_); }
  void Add(std::span<const uint8_t> bytes) {
    XXH3_64bits_update(&state_, bytes.data(), bytes.size());
  }
  /// The checksum as it stands in the file; begins the next group.
  std::vector<uint8_t> Close() {
    std::vector<uint8_t> bytes;
    AppendLittleEndian(static_cast<uint32_t>(XXH3_64bits_digest(&state_)), &bytes);
    XXH3_64bits_reset(&state_);
    return bytes;
  }

 private:
  XXH3_state_t state_;
};

std::span<const uint8_t> CheckedSegment(const FileTable& table, const SegmentBytes& segment,
                                        size_t layer, size_t subtree, SegmentPart part) {
  const auto bytes = segment(layer, subtree, part);
  const uint64_t announced = table.segment_bytes[table.SegmentIndex(layer, subtree, part)];
  if (bytes.size() == announced) return bytes;
  throw Failure(
      ErrorKind::kInternal,
      "segment of layer " + std::to_string(layer) + ", subtree " + std::to_string(subtree) +
          (part == SegmentPart::kInner ? ", inner has " : ", seam has ") +
          std::to_string(bytes.size()) + " bytes, the table says " + std::to_string(announced));
}

/// Of all sections; their bytes are given.
uint64_t AppendSections(const FileTable& table, const SectionBytes& section, BufferedFile* file) {
  uint64_t bytes = 0;
  for (size_t i = 0; i < kSectionKinds; ++i) {
    if (!table.sections[i]) continue;
    const auto all = section(static_cast<SectionKind>(i));
    if (all.size() != table.sections[i]->bytes) {
      throw Failure(ErrorKind::kInternal,
                    "section " + std::to_string(i) + " is not as long as the table says");
    }
    file->Append(all);
    bytes += all.size();
  }
  return bytes;
}

}  // namespace

uint64_t WriteContainer(const FileTable& table, const SegmentBytes& segment, AtomicFile& out,
                        const SectionBytes& section) {
  const std::vector<CodedTable> tables = EncodeTables(table);
  const std::vector<uint8_t> header = EncodeHeader(tables[0].bytes);
  FileLayout layout(header.size());
  BufferedFile file(&out);
  file.Append(header);
  GroupHash hash;
  uint64_t at = header.size();
  const auto append = [&](std::span<const uint8_t> bytes) {
    file.Append(bytes);
    hash.Add(bytes);
    at += bytes.size();
  };
  const auto close = [&] {
    file.Append(hash.Close());
    at += kGroupChecksumBytes;
  };
  size_t layer = 0, group = 0;
  for (const CodedTable& coded : tables) {
    if (layer > 0) {
      append(coded.bytes);
      close();
      layout.AddTable(coded.bytes.size());
    }
    layout.AddLayers(table, coded.end_layer);
    for (; layer < coded.end_layer; ++layer) {
      for (size_t subtree = 0; subtree < table.subtrees.size(); ++subtree) {
        for (const SegmentPart part : {SegmentPart::kInner, SegmentPart::kSeam}) {
          const auto bytes = CheckedSegment(table, segment, layer, subtree, part);
          append(bytes);
          if (bytes.empty() || at < layout.groups()[group].end) continue;
          close();
          ++group;
        }
      }
    }
  }
  at += AppendSections(table, section, &file);
  file.Flush();
  return at;
}

}  // namespace folprom::io
