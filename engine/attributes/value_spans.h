// What the coder knows of each attribute before the first value.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/attributes/value_model.h"
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
      found &= one.name == kNames[i] && IsFloat(one.type);
    }
    if (found) return static_cast<uint32_t>(axis) + 1;
  }
  return 0;
}

/// Ranges: of each attribute.
inline std::vector<ValueSpan> ValueSpansOf(const io::VertexSchema& schema,
                                           std::span<const io::AttributeRange> ranges) {
  std::vector<ValueSpan> spans;
  for (size_t a = 0; a < schema.attributes.size(); ++a) {
    spans.push_back({schema.attributes[a].type, ranges[a].least, ranges[a].most,
                     NormalAxis(schema, a), ranges[a].step, ranges[a].first});
  }
  return spans;
}

}  // namespace folprom
