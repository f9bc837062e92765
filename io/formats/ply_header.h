// What a PLY file says that it holds.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/formats/mesh_source.h"

namespace folprom::io {

enum class PlyFormat : uint8_t { kAscii, kBinaryLittleEndian, kBinaryBigEndian };

struct PlyProperty {
  std::string name;
  ScalarType type = ScalarType::kFloat32;  ///< of the value, or of the items of a list
  bool is_list = false;
  ScalarType count_type = ScalarType::kUint8;  ///< an integer type; of a list only
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;
  std::vector<std::string>
      remarks;                   ///< lines "comment" and "obj_info", up to Limits::comment_bytes
  uint64_t remarks_dropped = 0;  ///< further ones
  uint64_t data_begin = 0;       ///< offset of the first byte behind the header
  uint64_t line_count = 0;       ///< lines of the header
};

/// True where the bytes begin as a PLY file does: a first line that is "ply".
bool HasPlyMagic(std::span<const uint8_t> bytes);

/// Parses the header at the start of `bytes`. Throws Failure kInput that names `path`, the line and
/// the reason, or kLimit. Counts are not compared with the bytes there are: see IndexPlyBlocks.
PlyHeader ParsePlyHeader(std::span<const uint8_t> bytes, const std::string& path,
                         const Limits& limits);

}  // namespace folprom::io
