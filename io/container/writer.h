// Writes a .folp file: tables and segments, layer by layer, in one pass.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "folprom/result.h"
#include "io/container/file_table.h"
#include "io/files/atomic_file.h"

namespace folprom::io {

/// Gives the bytes of a segment, valid until the next call (a lambda that returns a vector would
/// give a dangling span). Called once per segment, also for the empty ones, in the order of the
/// file: layer, subtree, inner before seam.
using SegmentBytes =
    std::function<std::span<const uint8_t>(size_t layer, size_t subtree, SegmentPart part)>;

/// Gives the bytes of a section that the table has, valid until the next call.
using SectionBytes = std::function<std::span<const uint8_t>(SectionKind kind)>;

/// Appends tables, segments and sections to `out` (does not commit). The file's size is returned.
/// Thread-compatible; holds the tables and a buffer of 256 KiB. Throws Failure: kOutput; kInternal
/// when the table contradicts itself or a segment is not as long as the table says; kLimit when the
/// first table takes 4 GiB or more; and what `segment` throws.
uint64_t WriteContainer(const FileTable& table, const SegmentBytes& segment, AtomicFile& out,
                        const SectionBytes& section = {});

}  // namespace folprom::io
