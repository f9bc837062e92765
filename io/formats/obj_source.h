// OBJ files as a MeshSource: positions and faces; the rest is named in the notes.
#pragma once

#include <memory>

#include "io/files/mapped_file.h"
#include "io/formats/mesh_source.h"

namespace folprom::io {

/// Throws Failure kInput, with the line.
std::unique_ptr<MeshSource> OpenObjSource(MappedFile file);

}  // namespace folprom::io
