#include "engine/resolution.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "engine/codec/parameters.h"

namespace folprom {
namespace {

constexpr double kLatticeLimit = 1 << 30;

/// Sides of the box for which error bounds stay inside a float and steps above its finest.
constexpr double kSmallestSide = 1e-280, kLargestSide = kLargestTolerance;

std::string Text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

/// Distance from a float or double of this size to the next.
double StepOf(ScalarType type, double size) {
  if (type == ScalarType::kFloat32) {
    float value = static_cast<float>(size);
    return static_cast<double>(std::nextafter(value, INFINITY)) - static_cast<double>(value);
  }
  return std::nextafter(size, static_cast<double>(INFINITY)) - size;
}

}  // namespace

ScalarType OutputType(ScalarType input) {
  switch (input) {
    case ScalarType::kFloat64:
    case ScalarType::kInt32:
    case ScalarType::kUint32:
      return ScalarType::kFloat64;
    default:
      return ScalarType::kFloat32;
  }
}

Resolution ResolutionOf(const Bounds& bounds, ScalarType type, const EncodeOptions& options) {
  Resolution result;
  if (bounds.empty()) return result;
  double longest = bounds.longest();
  if (longest > kLargestSide || (longest > 0 && longest < kSmallestSide)) {
    throw Failure(ErrorKind::kInput, "the coordinates span " + Text(longest) + "; sides from " +
                                         Text(kSmallestSide) + " to " + Text(kLargestSide) +
                                         " can be coded, others with --exact");
  }
  double steps = static_cast<double>((uint64_t{1} << options.bits) - 1);
  result.tolerance = options.tolerance > 0 ? options.tolerance : longest / steps / 2;
  result.lattice.origin = bounds.lo;
  if (!(longest > 0)) return result;
  // Writing to float or double rounds once more: half a step of the output. Below that half the
  // tolerance is always enough, since a vertex nearer than half a step rounds to its own value.
  double largest = 0;
  for (size_t i = 0; i < 3; ++i) {
    largest = std::max({largest, std::fabs(bounds.lo[i]), std::fabs(bounds.hi[i])});
  }
  double inner =
      std::max(result.tolerance - StepOf(OutputType(type), largest) / 2, result.tolerance / 2);
  result.lattice.unit =
      options.codec.offsets == Offsets::kLattice ? 2 * inner : inner / kUnitsPerTolerance;
  if (!(longest / result.lattice.unit < kLatticeLimit - 2)) {
    throw Failure(ErrorKind::kUsage, "tolerance " + Text(result.tolerance) +
                                         " is too fine for coordinates up to " + Text(largest) +
                                         " that span " + Text(longest));
  }
  for (size_t i = 0; i < 3; ++i) {
    double side = (bounds.hi[i] - bounds.lo[i]) / result.lattice.unit;
    result.lattice.extent[i] = static_cast<int32_t>(std::ceil(side));
  }
  return result;
}

}  // namespace folprom
