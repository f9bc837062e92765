// OBJ files as a MeshSource: what is not read of them is named in the notes.
#pragma once

#include <memory>

#include "io/files/mapped_file.h"
#include "io/formats/mesh_source.h"

namespace folprom::io {

/// Throws Failure kInput, with the line.
std::unique_ptr<MeshSource> OpenObjSource(MappedFile file, const Limits& limits);

}  // namespace folprom::io
