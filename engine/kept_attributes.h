// What an encoding keeps beside positions and faces.
#pragma once

#include "folprom/settings.h"

namespace folprom {

/// Are the attributes of vertices, of faces and of their corners coded, if there are any. Comments
/// are kept with any codec.
inline bool KeepsAttributes(const EncodeOptions& options) {
  return options.attributes && options.codec.offsets == Offsets::kLattice;
}

}  // namespace folprom
