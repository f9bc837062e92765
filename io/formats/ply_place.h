// The record of a PLY file that is being read, for messages.
#pragma once

#include <cstdint>
#include <string>

#include "io/formats/file_position.h"
#include "io/formats/ply_header.h"

namespace folprom::io {

/// The record being read.
struct PlyPlace {
  const std::string* path = nullptr;
  const PlyElement* element = nullptr;
  uint64_t record = 0;

  /// "file: face 7: reason".
  Failure Fault(const std::string& reason) const {
    return {ErrorKind::kInput,
            *path + ": " + element->name + " " + std::to_string(record) + ": " + reason};
  }
};

}  // namespace folprom::io
