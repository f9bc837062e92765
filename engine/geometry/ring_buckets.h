// Contexts that a ring gives, a RingShape as well as a LightRing.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "engine/geometry/buckets.h"
#include "engine/mesh/types.h"

namespace folprom {

inline constexpr uint32_t kCountBuckets = 16;
/// Up to 3 neighbours, 4 .. 9, more; open rings apart from closed ones.
template <class Ring>
uint32_t CountBucket(const Ring& ring) {
  return std::clamp(ring.count, 3u, 10u) - 3 + (ring.is_open ? 8 : 0);
}

inline constexpr uint32_t kEccentricityBuckets = 6;
/// Of the distance of the neighbours' mean, in spacings.
template <class Ring>
uint32_t EccentricityBucket(const Ring& ring) {
  constexpr std::array<double, kEccentricityBuckets - 1> kBounds{0.06, 0.12, 0.2, 0.3, 0.45};
  return Bucket(std::sqrt(Dot(ring.mean, ring.mean)) * (1 / ring.spacing), kBounds);
}

inline constexpr uint32_t kSideBuckets = 9;
/// Of a way along an axis, in spacings; 4 is next to 0.
inline uint32_t SideBucket(double spacings) {
  constexpr std::array<double, kSideBuckets - 1> kBounds{-1.2, -0.8, -0.45, -0.15,
                                                         0.15, 0.45, 0.8,   1.2};
  return Bucket(spacings, kBounds);
}

}  // namespace folprom
