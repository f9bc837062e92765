// Which levels of detail to show of a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "folprom/folprom.h"

namespace folprom::render {

/// Numbers of layers, rising, each once, at most `count`: from a mesh that one can just
/// recognise to what lies below the finest, by even factors of the vertices. Only layers that are
/// there; without the last of them.
std::vector<uint32_t> SpreadLevels(const FileInfo& info, size_t count);

/// For each of the rates, in bits per vertex of the original, how many layers fit into it, at least
/// one; rising, each once.
std::vector<uint32_t> LevelsAt(const FileInfo& info, std::span<const double> rates);

}  // namespace folprom::render
