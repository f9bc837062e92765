// Steps over what is not read, with either cursor.
#pragma once

#include "io/formats/ply_header.h"

namespace folprom::io {

/// Over the property at the cursor, be it a scalar or a list.
template <class Cursor>
void SkipProperty(const PlyProperty& property, Cursor& cursor) {
  if (property.is_list) {
    cursor.SkipItems(property.type, cursor.Count(property.count_type));
  } else {
    cursor.Skip(property.type);
  }
}

}  // namespace folprom::io
