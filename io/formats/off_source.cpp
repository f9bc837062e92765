#include "io/formats/off_source.h"

#include <utility>

namespace folprom::io {

std::unique_ptr<MeshSource> OpenOffSource(MappedFile file) {
  const OffHeader header = ParseOffHeader(file);
  return header.is_binary ? OpenBinaryOffSource(std::move(file), header)
                          : OpenTextOffSource(std::move(file), header);
}

}  // namespace folprom::io
