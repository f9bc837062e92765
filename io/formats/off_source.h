// OFF files, text and binary, as a MeshSource: positions and faces; the rest is named in the notes.
#pragma once

#include <memory>

#include "io/files/mapped_file.h"
#include "io/formats/mesh_source.h"
#include "io/formats/off_header.h"

namespace folprom::io {

/// All throw Failure kInput.
std::unique_ptr<MeshSource> OpenOffSource(MappedFile file);
std::unique_ptr<MeshSource> OpenTextOffSource(MappedFile file, const OffHeader& header);
std::unique_ptr<MeshSource> OpenBinaryOffSource(MappedFile file, const OffHeader& header);

}  // namespace folprom::io
