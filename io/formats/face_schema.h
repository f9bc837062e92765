// What a mesh file has of each face beside its corners.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "folprom/scalar_type.h"
#include "io/formats/vertex_schema.h"

namespace folprom::io {

/// Values of a list for each corner of a face, at most.
inline constexpr uint32_t kMostPerCorner = 16;

/// Of the numbers of a face, and of those of a corner; what a row takes stays in proportion to what
/// the file has.
inline constexpr size_t kMostFaceBytes = 256;

/// A number that each face has, or a list of so many numbers for each of its corners.
struct FaceAttribute {
  std::string name;
  ScalarType type = ScalarType::kUint8;
  uint32_t per_corner = 0;  ///< 0: one number a face; else 1 .. kMostPerCorner numbers a corner

  size_t columns() const { return per_corner == 0 ? 1 : per_corner; }
  size_t bytes() const { return columns() * ScalarSize(type); }
  bool operator==(const FaceAttribute&) const = default;
};

/// Values are given triangle by triangle as *rows*: the numbers of the face, then for each of the
/// three corners the numbers of that corner, each in the order of the attributes, lowest byte
/// first. The triangles that a polygon is cut into repeat what they share.
struct FaceSchema {
  std::vector<FaceAttribute> attributes;  ///< in the order of the file
  size_t before_indices = 0;              ///< so many of them stand before the list of indices

  bool empty() const { return attributes.empty(); }
  /// Bytes of the numbers of a face.
  size_t FaceBytes() const { return BytesOf(false); }
  /// Bytes of the numbers of a corner.
  size_t CornerBytes() const { return BytesOf(true); }
  size_t RowBytes() const { return FaceBytes() + 3 * CornerBytes(); }
  size_t Columns() const {
    size_t columns = 0;
    for (const FaceAttribute& attribute : attributes) columns += attribute.columns();
    return columns;
  }
  /// Is there room for one more.
  bool HasRoomFor(const FaceAttribute& more) const {
    return Columns() + more.columns() <= kMostAttributes &&
           BytesOf(more.per_corner > 0) + more.bytes() <= kMostFaceBytes;
  }
  bool operator==(const FaceSchema&) const = default;

 private:
  size_t BytesOf(bool of_corner) const {
    size_t bytes = 0;
    for (const FaceAttribute& attribute : attributes) {
      if ((attribute.per_corner > 0) == of_corner) bytes += attribute.bytes();
    }
    return bytes;
  }
};

/// Can stand in the header of a file: printable, no blank, not the name of the indices.
inline bool IsFaceAttributeName(std::string_view name) {
  return !name.empty() && name.size() <= kLongestAttributeName && name != "vertex_indices" &&
         name != "vertex_index" &&
         std::ranges::all_of(name, [](char c) { return c >= '!' && c <= '~'; });
}

}  // namespace folprom::io
