// Mapped files that somebody else makes shorter: their last pages are gone, and reading them is a
// SIGBUS, which ends the program.
#pragma once

#include <cstddef>

namespace folprom::io {

/// Pages of a MappedFile that are gone read as zeros from now on; MappedFile::CheckUnchanged tells.
/// Installs a handler of SIGBUS, and so is for programs to call, before they open files.
void ReadCutPagesAsZeros();

/// A mapping whose pages may go. Up to 1,024 at a time are known, others end the program still.
void AddMapping(const void* begin, size_t size);
void RemoveMapping(const void* begin);

}  // namespace folprom::io
