// A border record as a spilled file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/codec/border_record.h"
#include "engine/codec/encode_subtree.h"
#include "io/spill/spill.h"

namespace folprom {

std::string BorderName(uint32_t subtree);
/// Writes the record as file BorderName of the spill. Returns its XXH3.
uint64_t SpillBorder(const io::SpillDirectory& spill, uint32_t subtree, const BorderRecord& record,
                     const BorderVertices& vertices);
/// Bytes of the files of these subtrees; in memory they take as much.
uint64_t BorderBytes(const io::SpillDirectory& spill, const std::vector<uint32_t>& subtrees);
BorderFile LoadBorder(const io::SpillDirectory& spill, uint32_t subtree);

}  // namespace folprom
