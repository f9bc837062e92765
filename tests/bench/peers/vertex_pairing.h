// Which original vertex each decoded vertex is.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "tests/bench/peers/mesh_file.h"

namespace folprom::peers {

inline constexpr uint32_t kNoVertex = std::numeric_limits<uint32_t>::max();

/// Is decoded vertex i within `tolerance` per axis of original vertex i, for all i, and are there
/// as many.
bool InSameOrder(const Mesh& original, const Mesh& decoded, double tolerance);

/// For each decoded vertex an original one within `tolerance` (above 0) per axis, or kNoVertex; no
/// original vertex twice. The identity where InSameOrder. Else those with one vertex in reach are
/// paired with it; of the others, faces exclude candidates until one is left.
std::vector<uint32_t> PairVertices(const Mesh& original, const Mesh& decoded, double tolerance);

}  // namespace folprom::peers
