// What the faces of a PLY file have beside their corners.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/formats/face_schema.h"
#include "io/formats/mesh_source.h"
#include "io/formats/ply_layout.h"
#include "io/formats/ply_skip.h"
#include "io/formats/ply_value.h"

namespace folprom::io {

/// The rows of whole faces: FaceSchema.
template <class Cursor>
class PlyFaceRows {
 public:
  PlyFaceRows(Cursor& cursor, const PlyElementPlan& plan, const FaceSchema& schema)
      : cursor_(cursor),
        plan_(plan),
        schema_(schema),
        face_bytes_(schema.FaceBytes()),
        corner_bytes_(schema.CornerBytes()) {}

  /// From the record on, until there are so many triangles.
  void Read(uint64_t record, uint64_t triangles, std::vector<uint8_t>* rows) {
    const size_t bytes = triangles * schema_.RowBytes();
    rows->clear();
    rows->reserve(bytes);
    for (; rows->size() < bytes; ++record) {
      cursor_.BeginRecord(record);
      const uint64_t corners = ReadRecord();
      cursor_.EndRecord();
      AddRows(corners, rows);
    }
  }

 private:
  /// Returns the number of corners.
  uint64_t ReadRecord() {
    const std::vector<PlyProperty>& properties = plan_.element->properties;
    uint64_t corners = 0;
    size_t next = 0, of_face = 0, of_corner = 0;
    face_.resize(face_bytes_);
    for (size_t p = 0; p < properties.size(); ++p) {
      const PlyProperty& property = properties[p];
      if (p == plan_.index_list) {
        corners = cursor_.Count(property.count_type);
        cursor_.SkipItems(property.type, corners);
      } else if (next == plan_.attributes.size() || plan_.attributes[next] != p) {
        SkipProperty(property, cursor_);
      } else if (const FaceAttribute& attribute = schema_.attributes[next++];
                 attribute.per_corner == 0) {
        ReadValue(cursor_, property.type, &face_[of_face]);
        of_face += attribute.bytes();
      } else {
        ReadCorners(property, attribute, of_corner);
        of_corner += attribute.bytes();
      }
    }
    return corners;
  }

  /// Of a face of less than three corners the list may have any length.
  void ReadCorners(const PlyProperty& property, const FaceAttribute& attribute, size_t at) {
    const uint64_t items = cursor_.Count(property.count_type);
    const uint64_t corners = items / attribute.per_corner;
    if (corners < 3 || corners > kBlockTriangles + 2) {
      cursor_.SkipItems(property.type, items);
      return;
    }
    if (corners_.size() < corners * corner_bytes_) corners_.resize(corners * corner_bytes_);
    for (uint64_t corner = 0; corner < corners; ++corner) {
      uint8_t* to = &corners_[corner * corner_bytes_ + at];
      for (uint32_t i = 0; i < attribute.per_corner; ++i) {
        to = ReadValue(cursor_, property.type, to);
      }
    }
  }

  void AddRows(uint64_t corners, std::vector<uint8_t>* rows) const {
    // The walk saw that lists are long enough, unless the file has changed since.
    if (corner_bytes_ > 0 && corners >= 3 && corners_.size() < corners * corner_bytes_) {
      throw cursor_.place().Fault("the file has changed while it was read");
    }
    const auto add_corner = [&](uint64_t corner) {
      const auto from = corners_.begin() + static_cast<std::ptrdiff_t>(corner * corner_bytes_);
      if (corner_bytes_ > 0) {
        rows->insert(rows->end(), from, from + static_cast<std::ptrdiff_t>(corner_bytes_));
      }
    };
    for (uint64_t corner = 2; corner < corners; ++corner) {
      rows->insert(rows->end(), face_.begin(), face_.end());
      add_corner(0);
      add_corner(corner - 1);
      add_corner(corner);
    }
  }

  Cursor& cursor_;
  const PlyElementPlan& plan_;
  const FaceSchema& schema_;
  size_t face_bytes_, corner_bytes_;
  std::vector<uint8_t> face_, corners_;  ///< of the record
};

}  // namespace folprom::io
