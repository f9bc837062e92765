// The tables as bytes. What each byte means stands in FORMAT.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/container/byte_code.h"
#include "io/container/file_table.h"

namespace folprom::io {

/// What contradicts itself in a table, with its place ("subtree 3: box outside the extent"); empty
/// when nothing does. The sizes of all segments together stay below 2^62.
std::string TableFault(const FileTable& table);

/// One of the tables of a file.
struct CodedTable {
  size_t end_layer = 0;  ///< it tells of the layers before this one
  std::vector<uint8_t> bytes;
};

/// The first table, which stands in the header, and those that stand between layers, each where
/// the bytes have doubled. Failure kInternal with the fault of a table that has one.
std::vector<CodedTable> EncodeTables(const FileTable& table);

/// Puts a table together from those of a file, which come in their order.
class TableDecoder {
 public:
  /// file: for messages, borrowed. most_bytes: what the sizes of the segments and their places in
  /// the file may take.
  explicit TableDecoder(std::string_view file, uint64_t most_bytes = ~uint64_t{0})
      : file_(file), most_bytes_(most_bytes) {}

  /// Reads a table that must fill `bytes` exactly. `offset` is the position of the first byte in
  /// the file. Allocates at most 128 bytes per byte of table for the sizes: a bit may hold one,
  /// beside that of a seam segment which has none. Failure kCorrupt naming file, place and reason,
  /// kLimit where the sizes would take more than most_bytes.
  void Decode(std::span<const uint8_t> bytes, uint64_t offset);

  const FileTable& table() const { return table_; }
  FileTable TakeTable() && { return std::move(table_); }
  size_t layers_total() const { return layers_total_; }
  /// Bytes of the next table, which stands behind the layers that are known; 0: there is none.
  uint64_t next_bytes() const { return next_bytes_; }

 private:
  void DecodeMesh(ByteReader* in);
  void DecodeLayers(ByteReader* in);

  std::string_view file_;
  uint64_t most_bytes_;
  FileTable table_;
  bool has_mesh_ = false;
  size_t layers_total_ = 0;
  uint64_t next_bytes_ = 0;
};

}  // namespace folprom::io
