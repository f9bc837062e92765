// Tells the planes of a subtree.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/entropy/integer_model.h"
#include "engine/mesh/coordinate_planes.h"
#include "engine/mesh/types.h"

namespace folprom {

/// Most planes of an axis.
inline constexpr uint32_t kMostPlanes = 1 << 16;

class PlaneCoder {
 public:
  /// Coordinates lie in [lo, hi].
  PlaneCoder(const Int3& lo, const Int3& hi) : lo_(lo), hi_(hi) {}

  /// found: encoder only; null where there are none, which is what is then returned. Throws Failure
  /// kCorrupt.
  template <class Coder>
  std::shared_ptr<const CoordinatePlanes> Code(Coder& coder,
                                               std::shared_ptr<const CoordinatePlanes> found);

 private:
  template <class Coder>
  std::vector<int32_t> CodeAxis(Coder& coder, int32_t lo, int32_t hi,
                                std::span<const int32_t> planes);

  Int3 lo_, hi_;
  IntegerModel<1> counts_{{1}}, gaps_{{1}}, changes_{{1}};
};

}  // namespace folprom
