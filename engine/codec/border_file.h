// A border record as a spilled file.
#pragma once

#include <string>

#include "engine/codec/border_record.h"
#include "engine/codec/encode_subtree.h"
#include "io/spill/spill.h"

namespace folprom {

/// Writes the record as file "border.<subtree>" of the spill.
void SpillBorder(const io::SpillDirectory& spill, uint32_t subtree, const BorderRecord& record,
                 const BorderVertices& vertices);
BorderFile LoadBorder(const io::SpillDirectory& spill, uint32_t subtree);

}  // namespace folprom
