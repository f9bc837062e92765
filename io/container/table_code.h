// The table as bytes. What each byte means stands in FORMAT.md.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/container/file_table.h"

namespace folprom::io {

/// What contradicts itself in a table, with its place ("subtree 3: box outside the extent"); empty
/// when nothing does. The sizes of all segments together stay below 2^62.
std::string TableFault(const FileTable& table);

/// The bytes of a table. Failure kInternal with the fault of a table that has one.
std::vector<uint8_t> EncodeTable(const FileTable& table);

/// Reads a table that must fill `bytes` exactly. `file` is used in messages, `offset` is the
/// position of the first byte in it. Allocates at most 128 bytes per byte of table for the sizes: a
/// bit may hold one, beside that of a seam segment which has none. Failure kCorrupt naming file,
/// place and reason.
FileTable DecodeTable(std::span<const uint8_t> bytes, std::string_view file, uint64_t offset);

}  // namespace folprom::io
