// The sizes of all segments in few bits: each predicted from the layer before, its error coded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "io/container/byte_code.h"
#include "io/container/row_code.h"

namespace folprom::io {

/// What the sizes of a table are sizes of. Layers below 2^12, subtrees below 2^32.
struct SizeGrid {
  uint64_t layers = 0;  ///< behind those whose sizes are known
  uint64_t subtrees = 0;
  bool seams = false;  ///< has any subtree a lower neighbour; if not, seam segments have no bytes

  uint64_t parts() const { return seams ? 2 : 1; }
  /// What the sizes take at least: a bit each and the order of a row.
  uint64_t LeastBits() const { return parts() * (layers * subtrees + kRowParameterBits); }
};

/// Appends the last grid.layers of sizes[(layer * subtrees + subtree) * 2 + part], each below 2^32.
void WriteSizes(std::span<const uint64_t> sizes, const SizeGrid& grid, BitWriter* bits);

/// Appends what WriteSizes wrote behind the same sizes. The caller has checked LeastBits against
/// the bytes left. Failure kCorrupt, at the place of `in`, from which `bits` takes its bytes.
void ReadSizes(const SizeGrid& grid, const ByteReader& in, BitReader* bits,
               std::vector<uint64_t>* sizes);

}  // namespace folprom::io
