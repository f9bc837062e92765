// Reads a .folp file from a span of bytes. C++ standard library and xxHash only.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "folprom/result.h"
#include "io/container/file_table.h"
#include "io/container/layout.h"

namespace folprom::io {

/// A .folp file, whole or cut. Thread-safe after Open. Does not own the bytes. Copies share what
/// they know to be undamaged.
class ContainerReader {
 public:
  /// `bytes` must outlive the reader. `name` is used in messages. kCorrupt: cut inside the header
  /// (also empty), checksum of a table wrong, counts that contradict each other or the bytes that
  /// are left, or bytes after the announced end. kInput: not a .folp file, or a format version that
  /// this program does not know. kLimit: too little memory for the tables.
  /// Reads the bytes of header and tables only, so a mapped file stays on disk.
  static Result<ContainerReader> Open(std::span<const uint8_t> bytes, std::string name);

  /// Of a cut file, what the tables that are there say.
  const FileTable& table() const { return table_; }
  /// Layers of the whole file; table() may know fewer where it is cut.
  size_t layers_total() const { return layers_total_; }
  bool has_all_tables() const { return table_.layers.size() == layers_total_; }
  const std::string& name() const { return name_; }
  /// "scan.folp: layer 3, subtree 5, inner segment: ", for messages.
  std::string PlaceOf(size_t layer, size_t subtree, SegmentPart part) const;
  /// Layers whose segments and checksums are all inside the bytes (a cut file has fewer than the
  /// whole one).
  size_t complete_layers() const { return complete_layers_; }
  /// The bytes of one segment, verified by the checksum of its group (once per group; an empty
  /// segment has none). kCorrupt when it differs or lies beyond the end.
  Result<std::span<const uint8_t>> Segment(size_t layer, size_t subtree, SegmentPart part) const;

  /// Is the section in the file, and whole.
  bool HasSection(SectionKind kind) const;
  /// The bytes of one that is there, not verified yet: see BlockReader.
  std::span<const uint8_t> Section(SectionKind kind) const;

  /// Byte positions of layer k < table().layers.size(): LayerEnd(k) bytes are needed to decode
  /// layers 0 .. k.
  uint64_t LayerBegin(size_t layer) const { return layout_.layer_begin()[layer]; }
  uint64_t LayerEnd(size_t layer) const { return layout_.layer_end()[layer]; }
  uint64_t header_bytes() const { return header_bytes_; }  ///< with the first table
  /// Header, tables and their checksums, and checksums of segments.
  uint64_t table_bytes() const { return layout_.table_bytes(); }
  uint64_t checksum_bytes() const { return layout_.checksum_bytes(); }
  /// Of the whole file; of a cut one without all tables, as far as they tell.
  uint64_t file_bytes() const { return layout_.end(); }

 private:
  ContainerReader() = default;
  void Load(std::span<const uint8_t> bytes, std::string name);
  void LoadTables();
  size_t GroupOf(uint64_t position) const;
  bool Intact(size_t group) const;

  std::span<const uint8_t> bytes_;
  std::string name_;
  FileTable table_;
  size_t layers_total_ = 0, complete_layers_ = 0;
  uint64_t header_bytes_ = 0;
  FileLayout layout_;
  /// Groups found undamaged. Two threads may find the same at once; no other memory depends on it.
  std::shared_ptr<std::atomic<bool>[]> verified_;
};

}  // namespace folprom::io
