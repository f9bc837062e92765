// Cuts polygons into triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "io/formats/mesh_source.h"

namespace folprom::io {

/// The triangles of one polygon, from its first corner on.
class PolygonFan {
 public:
  /// joins: as of MeshSource::ReadPolygonBlock; may be null.
  explicit PolygonFan(std::vector<Triangle>& out, std::vector<uint8_t>* joins = nullptr)
      : out_(out), joins_(joins) {}
  void AddCorner(uint64_t vertex) {
    if (corners_ == 0) first_ = vertex;
    if (corners_ >= 2) {
      out_.push_back({first_, last_, vertex});
      if (joins_ != nullptr) joins_->push_back(corners_ > 2 ? 1 : 0);
    }
    last_ = vertex;
    ++corners_;
  }

 private:
  std::vector<Triangle>& out_;
  std::vector<uint8_t>* joins_;
  uint64_t first_ = 0, last_ = 0, corners_ = 0;
};

/// Triangles of a polygon of `corners` corners, counted in the notes where it is no triangle.
inline uint64_t FanTriangles(uint64_t corners, SourceNotes& notes) {
  if (corners < 3) ++notes.polygons_dropped;
  if (corners > 3) ++notes.polygons_triangulated;
  return corners < 3 ? 0 : corners - 2;
}

}  // namespace folprom::io
