// Which attributes are the normal of the surface.
#pragma once

#include <cstdint>

#include "io/formats/vertex_schema.h"

namespace folprom {

/// ValueSpan::normal_axis of an attribute: floats nx, ny and nz, one behind the other.
inline uint32_t NormalAxis(const io::VertexSchema& schema, size_t attribute) {
  constexpr const char* kNames[] = {"nx", "ny", "nz"};
  const auto& all = schema.attributes;
  for (size_t axis = 0; axis < 3; ++axis) {
    if (attribute < axis || attribute - axis + 3 > all.size()) continue;
    bool found = true;
    for (size_t i = 0; i < 3; ++i) {
      const io::VertexAttribute& one = all[attribute - axis + i];
      found &= one.name == kNames[i] && io::IsFloat(one.type);
    }
    if (found) return static_cast<uint32_t>(axis) + 1;
  }
  return 0;
}

}  // namespace folprom
