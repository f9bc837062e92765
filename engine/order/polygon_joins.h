// Which triangles are one face of the scan, where their order is known.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "engine/entropy/mixed_model.h"
#include "engine/mesh/types.h"

namespace folprom {

/// A polygon is the triangles (a, b, c), (a, c, d), (a, d, e) ..., one after another: its fan. One
/// flag for each triangle that can go on with the fan of the triangle before it: does it.
class PolygonJoins {
 public:
  /// joins: a number for each triangle, 1 where it goes on; read or written.
  template <class Coder>
  void Code(Coder& coder, std::span<const Face> faces, std::span<uint8_t> joins) {
    for (size_t i = 0; i < faces.size(); ++i) {
      bool is_joined = false;
      if (has_last_ && faces[i][0] == last_[0] && faces[i][1] == last_[2]) {
        const uint32_t run = std::min(run_, kRuns - 1);
        is_joined = joined_.Code(coder, {run * kRuns + run_before_, run}, 0, joins[i] != 0);
      }
      joins[i] = is_joined ? 1 : 0;
      if (!is_joined) run_before_ = std::min(run_, kRuns - 1);
      run_ = is_joined ? run_ + 1 : 1;
      last_ = faces[i];
      has_last_ = true;
    }
  }

 private:
  static constexpr uint32_t kRuns = 32;
  MixedModel<2> joined_{{kRuns * kRuns, kRuns}};
  Face last_{};
  bool has_last_ = false;
  uint32_t run_ = 0, run_before_ = 0;  ///< triangles of this face, and of the one before
};

}  // namespace folprom
