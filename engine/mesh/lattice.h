// The working lattice: integers fine enough that rounding to them is lost in the tolerance.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "engine/mesh/exact_lattice.h"
#include "engine/mesh/types.h"
#include "folprom/result.h"

namespace folprom {

/// Bounding box of the input in model units; empty when lo > hi.
struct Bounds {
  std::array<double, 3> lo{1, 1, 1};
  std::array<double, 3> hi{0, 0, 0};
  bool empty() const { return lo[0] > hi[0]; }
  double longest() const;
  double diagonal() const;
};

/// position = origin + unit * k per axis, k in [0, 2^30). Both sides compute it in this order of
/// operations, so every machine gets the same double. An exact lattice divides integers instead;
/// origin and unit are then what it says of k = 0 and of a step.
struct Lattice {
  std::array<double, 3> origin{0, 0, 0};
  double unit = 1;
  std::array<int32_t, 3> extent{0, 0, 0};  ///< largest k per axis
  std::optional<ExactLattice> exact = {};

  double ToModel(int axis, int32_t k) const {
    const auto i = static_cast<size_t>(axis);
    return exact ? exact->ToModel(i, k) : origin[i] + unit * static_cast<double>(k);
  }
  std::array<double, 3> ToModel(const Int3& p) const {
    return {ToModel(0, p.x), ToModel(1, p.y), ToModel(2, p.z)};
  }
  /// Nearest lattice point, clamped to the box, the first one for NaN; of an exact lattice the
  /// point that rests go by.
  Int3 FromModel(const double* xyz) const;
};

/// How many lattice units the tolerance spans: rounding then costs 1/64 of the tolerance.
inline constexpr double kUnitsPerTolerance = 32;

}  // namespace folprom
