// To which child of a split something leans.
#pragma once

#include <algorithm>
#include <cstdint>

#include "engine/mesh/types.h"

namespace folprom {

inline constexpr uint32_t kLeanBuckets = 12;

inline double SquaredDistance(const Int3& a, const Int3& b) {
  double x = static_cast<double>(a.x) - b.x, y = static_cast<double>(a.y) - b.y,
         z = static_cast<double>(a.z) - b.z;
  return x * x + y * y + z * z;
}

/// Difference of squared distances to the children over that between them, in 1/128.
inline int32_t LeanOf(double to_first, double to_second, double between) {
  const double lean = between > 0 ? 128 * (to_first - to_second) / between : 0;
  return static_cast<int32_t>(std::clamp(lean, -1e6, 1e6));
}

/// How clear it is, whichever child it is.
inline uint32_t LeanBucket(int32_t lean) {
  constexpr int32_t kBounds[kLeanBuckets - 1] = {10, 22, 36, 52, 70, 90, 112, 140, 180, 250, 400};
  int32_t size = lean < 0 ? -lean : lean;
  uint32_t bucket = 0;
  while (bucket < kLeanBuckets - 1 && size >= kBounds[bucket]) ++bucket;
  return bucket;
}

}  // namespace folprom
