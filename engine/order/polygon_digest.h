// A sum over the faces of a scan that no order alters.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "engine/mesh/types.h"
#include "io/container/checksum.h"

namespace folprom {

/// Takes triangle by triangle, with their joins. The corner that a face begins with does not count.
class PolygonDigest {
 public:
  void Add(const Face& face, bool is_joined) {
    if (!is_joined) {
      Close();
      first_ = face;
      corners_ = 2;
      last_ = {face[0], face[1]};
      sum_ = 0;
    }
    Turn(face[2]);
  }
  /// Call once more at the end.
  void Close() {
    if (corners_ == 0) return;
    ++polygons_;
    largest_ = std::max(largest_, corners_);
    Turn(first_[0]);
    Turn(first_[1]);
    digest_ += Hash({sum_, corners_ - 2, 0});
    corners_ = 0;
  }
  uint64_t digest() const { return digest_; }
  uint64_t polygons() const { return polygons_; }
  /// Corners of the largest.
  uint64_t largest() const { return largest_; }

 private:
  static uint64_t Hash(const std::array<uint64_t, 3>& values) {
    return io::XxHash64({reinterpret_cast<const uint8_t*>(values.data()), sizeof values});
  }
  /// Each three corners in a row count for the face.
  void Turn(uint32_t corner) {
    sum_ += Hash({last_[0], last_[1], corner});
    last_ = {last_[1], corner};
    ++corners_;
  }

  Face first_{};
  std::array<uint64_t, 2> last_{};
  uint64_t corners_ = 0, sum_ = 0, digest_ = 0, polygons_ = 0, largest_ = 0;
};

}  // namespace folprom
