#include "io/formats/mesh_source.h"

#include <utility>

#include "io/files/mapped_file.h"
#include "io/formats/ply_header.h"
#include "io/formats/ply_source.h"

namespace folprom::io {

Result<std::unique_ptr<MeshSource>> MeshSource::Open(const std::string& path) {
  try {
    MappedFile file = MappedFile::Open(path).value();
    if (file.bytes().empty()) throw Failure(ErrorKind::kInput, path + ": the file is empty");
    if (!HasPlyMagic(file.bytes())) {
      throw Failure(ErrorKind::kInput, path + ": unsupported format (known formats: PLY)");
    }
    return OpenPlySource(std::move(file));
  } catch (const Failure& failure) {
    return failure.error();
  }
}

}  // namespace folprom::io
