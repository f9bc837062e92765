// The sizes of all segments in few bits: each predicted from the layer before, its error coded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "io/container/byte_code.h"

namespace folprom::io {

inline constexpr int kRowParameterBits = 5;

/// Bits that layers x subtrees x 2 sizes take at least: one each and a parameter a row. Both counts
/// below 2^32 and 2^12, so that nothing overflows.
inline uint64_t LeastSizeBits(uint64_t layers, uint64_t subtrees) {
  return 2 * layers * (subtrees + kRowParameterBits);
}

/// Appends sizes[(layer * subtrees + subtree) * 2 + part], each below 2^32, filled to a whole byte.
void WriteSizes(std::span<const uint64_t> sizes, size_t layers, size_t subtrees, ByteWriter* out);

/// Reads them back. The caller has checked LeastSizeBits against the bytes left. Failure kCorrupt.
std::vector<uint64_t> ReadSizes(size_t layers, size_t subtrees, ByteReader* in);

}  // namespace folprom::io
