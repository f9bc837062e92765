#include "engine/mesh/lattice.h"

#include <algorithm>

namespace folprom {

double Bounds::longest() const {
  if (empty()) return 0;
  return std::max({hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]});
}

double Bounds::diagonal() const {
  if (empty()) return 0;
  const double x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];
  return std::sqrt(x * x + y * y + z * z);
}

Int3 Lattice::FromModel(const double* xyz) const {
  std::array<int32_t, 3> k;
  for (size_t axis = 0; axis < 3; ++axis) {
    if (exact) {
      k[axis] = exact->Split(axis, extent[axis], xyz[axis]).k;
      continue;
    }
    const double steps = (xyz[axis] - origin[axis]) / unit;
    // In this order of arguments NaN becomes 0.
    const double clamped = std::min(std::max(0.0, steps), static_cast<double>(extent[axis]));
    k[axis] = static_cast<int32_t>(clamped);
    k[axis] += clamped - static_cast<double>(k[axis]) >= 0.5 ? 1 : 0;
  }
  return {k[0], k[1], k[2]};
}

}  // namespace folprom
