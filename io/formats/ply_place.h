// Where in a PLY file something is, for walking and for messages.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/formats/ply_header.h"

namespace folprom::io {

/// A place between two values of the body.
struct PlyPosition {
  uint64_t offset = 0;  ///< in bytes from the start of the file
  uint64_t line = 0;    ///< number of that line, the first being 1; text files only
};

/// Text of a file for a message: at most 60 characters, and none that would garble a terminal.
inline std::string Quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text.substr(0, 60)) quoted += c >= ' ' && c <= '~' ? c : '?';
  return quoted + (text.size() > 60 ? "...\"" : "\"");
}

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
