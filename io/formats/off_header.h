// The header of an OFF file: "[ST][C][N]OFF [BINARY]" and the counts.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/files/mapped_file.h"
#include "io/formats/file_position.h"

namespace folprom::io {

struct OffHeader {
  bool has_texture = false;  ///< ST: two texture coordinates a vertex
  bool has_colours = false;  ///< C: a colour a vertex
  bool has_normals = false;  ///< N: a normal a vertex
  bool is_binary = false;
  uint64_t vertices = 0;  ///< of text; a binary file has its counts in the body
  uint64_t faces = 0;
  FilePosition body;
};

/// Is the word the keyword of an OFF file, also of four or n dimensions.
bool IsOffKeyword(std::string_view word);

/// A missing keyword is "OFF". Throws Failure kInput, with the line; for 4OFF and nOFF by name.
OffHeader ParseOffHeader(const MappedFile& file);

}  // namespace folprom::io
