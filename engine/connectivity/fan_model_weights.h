// Where the weights of FanModel start: in units of bits.
#pragma once

#include <array>

namespace folprom {

/// Sum of squared slopes that a weight starts with: how firmly it is held.
inline constexpr float kFanSquares = 1;

inline constexpr std::array<float, 186> kFanWeights{};

}  // namespace folprom
