// Meshes as the bits of their coordinates, for what must come back exactly.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "folprom/settings.h"
#include "tests/support/mesh.h"

namespace folprom::support {

using Bits3 = std::array<uint64_t, 3>;

/// A mesh of floats (in the lower 32 bits) or doubles.
struct BitMesh {
  bool is_float = true;
  std::vector<Bits3> positions;
  std::vector<Triple> faces;
};

/// Binary little-endian PLY with no property but x, y, z and the indices.
void WriteBits(const std::string& path, const BitMesh& mesh);
/// Of such a file.
BitMesh ReadBits(const std::string& path);
/// The whole mesh as MemoryDecoder gives it.
BitMesh BitsFromMemory(const std::string& folp);

/// Empty when both have the same vertices and faces, told by nothing but their bits, in any order.
std::string DifferenceOfBits(const BitMesh& a, const BitMesh& b);

/// The settings of `encode --exact`.
EncodeOptions ExactOptions(uint32_t subtree_vertices = 1 << 24);

}  // namespace folprom::support
