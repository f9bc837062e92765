// The header of an OFF file: "[ST][C][N]OFF [BINARY]" and the counts.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/files/mapped_file.h"
#include "io/formats/file_position.h"

namespace folprom::io {

// Attributes that OFF has, in the order of its lines.
inline constexpr std::array<std::string_view, 3> kOffNormals{"nx", "ny", "nz"};
inline constexpr std::array<std::string_view, 4> kOffColours{"red", "green", "blue", "alpha"};
inline constexpr std::array<std::string_view, 2> kOffTexture{"s", "t"};
/// Of faces: the number of a colour in a map; where faces have colours of several forms, how many
/// of the numbers each has.
inline constexpr std::string_view kOffColourIndex = "colour_index",
                                  kOffColourCount = "colour_values";

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
