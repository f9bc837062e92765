// A sum over the faces of a scan and their values that no order alters.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/mesh/types.h"
#include "io/container/checksum.h"
#include "io/formats/face_schema.h"

namespace folprom {

/// Takes triangle by triangle, with their joins and rows. The corner that a face begins with does
/// not count.
class FaceValueDigest {
 public:
  explicit FaceValueDigest(const io::FaceSchema& schema)
      : face_bytes_(schema.FaceBytes()), corner_bytes_(schema.CornerBytes()) {}

  void Add(const Face& face, bool is_joined, std::span<const uint8_t> row) {
    const auto corner = [&](size_t i) {
      return row.subspan(face_bytes_ + i * corner_bytes_, corner_bytes_);
    };
    if (!is_joined) {
      Close();
      corners_ = 1;
      first_ = last_ = face[0];
      face_values_.assign(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(face_bytes_));
      first_values_.assign(corner(0).begin(), corner(0).end());
      AddCorner(face[1], corner(1));
    }
    AddCorner(face[2], corner(2));
  }
  /// Call once more at the end.
  void Close() {
    if (corners_ == 0) return;
    AddCorner(first_, first_values_);
    digest_ += Hash({sum_, corners_ - 1}, face_values_);
    sum_ = corners_ = 0;
  }
  uint64_t digest() const { return digest_; }

 private:
  uint64_t Hash(std::array<uint64_t, 2> numbers, std::span<const uint8_t> values) {
    const auto* bytes = reinterpret_cast<const uint8_t*>(numbers.data());
    bytes_.assign(bytes, bytes + sizeof numbers);
    bytes_.insert(bytes_.end(), values.begin(), values.end());
    return io::XxHash64(bytes_);
  }
  void AddCorner(uint64_t vertex, std::span<const uint8_t> values) {
    sum_ += Hash({last_, vertex}, values);
    last_ = vertex;
    ++corners_;
  }

  size_t face_bytes_, corner_bytes_;
  uint64_t first_ = 0, last_ = 0;  ///< vertices of the face
  uint64_t corners_ = 0, sum_ = 0, digest_ = 0;
  std::vector<uint8_t> face_values_, first_values_, bytes_;
};

}  // namespace folprom
