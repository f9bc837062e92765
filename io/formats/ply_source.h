// PLY files of every byte order and type as a MeshSource.
#pragma once

#include <memory>

#include "io/files/mapped_file.h"
#include "io/formats/mesh_source.h"

namespace folprom::io {

/// The file must have the PLY magic. Throws Failure kInput, kLimit.
std::unique_ptr<MeshSource> OpenPlySource(MappedFile file, const Limits& limits);

}  // namespace folprom::io
