// Contexts of the lattice's models: numbers in steps.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/entropy/cell_model.h"

namespace folprom {

/// Number of bounds, ascending, that the value reaches.
template <size_t K>
uint32_t Bucket(double value, const std::array<double, K>& bounds) {
  uint32_t bucket = 0;
  while (bucket < K && value >= bounds[bucket]) ++bucket;
  return bucket;
}

/// log2 in half octaves around 1, 0 .. 15.
inline uint32_t OctaveBucket(double value) {
  double halves = value > 0 ? 2 * 1.44269504 * detail::FastLog(value) : -100;
  return static_cast<uint32_t>(std::clamp(halves + 6, 0.0, 15.0));
}

/// A logistic density of scale s misses by 1.386 s on average.
inline constexpr double kScalePerMiss = 0.7213;

}  // namespace folprom
