// For files of which only small parts are read.
#pragma once

#include "io/files/mapped_file.h"

namespace folprom::io {

/// Tells the kernel to read no more than the pages that are touched, instead of what lies around
/// them too. A hint.
void ExpectSparseAccess(const MappedFile& file);

}  // namespace folprom::io
