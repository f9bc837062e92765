// The values of a scan's faces as the section of them needs them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/mesh/types.h"
#include "engine/order/polygon_set.h"
#include "io/formats/face_schema.h"

namespace folprom {

/// Widens the ranges of the columns to the values of the rows; begins them where there are none.
void AddToRanges(const io::FaceSchema& schema, std::span<const uint8_t> rows,
                 std::vector<io::AttributeRange>* ranges);

/// Rows (io::FaceSchema) of the triangles of a scan, in its order. Borrows all but the schema.
class FaceRows {
 public:
  FaceRows() = default;
  FaceRows(const io::FaceSchema& schema, std::span<const Face> faces, std::span<const uint8_t> rows)
      : face_bytes_(schema.FaceBytes()),
        corner_bytes_(schema.CornerBytes()),
        faces_(faces),
        rows_(rows) {}

  std::span<const uint8_t> Of(size_t triangle, size_t count = 1) const {
    return rows_.subspan(triangle * row_bytes(), count * row_bytes());
  }
  /// Of triangles by number, which are turned.
  std::vector<uint8_t> OfNumbers(const PolygonTruth& truth, uint32_t begin, uint32_t count) const;
  /// Of polygons that begin with any of their corners, as PolygonSet gives them.
  std::vector<uint8_t> OfPolygons(std::span<const Face> triangles, std::span<const uint8_t> joins,
                                  std::span<const PolygonTruth::Fan> fans) const;

 private:
  size_t row_bytes() const { return face_bytes_ + 3 * corner_bytes_; }
  std::span<const uint8_t> FaceOf(size_t triangle) const { return Of(triangle).first(face_bytes_); }
  std::span<const uint8_t> CornerOf(size_t triangle, size_t corner) const {
    return Of(triangle).subspan(face_bytes_ + corner * corner_bytes_, corner_bytes_);
  }
  /// How far the corners of a polygon are turned from those of the scan, whose triangles begin with
  /// `first`.
  size_t TurnOf(std::span<const Face> triangles, size_t first) const;

  size_t face_bytes_ = 0, corner_bytes_ = 0;
  std::span<const Face> faces_;
  std::span<const uint8_t> rows_;
};

}  // namespace folprom
