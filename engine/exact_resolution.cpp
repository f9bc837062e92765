#include "engine/exact_resolution.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace folprom {
namespace {

constexpr double kMostSteps = (1 << 30) - 4;
/// A lattice that leaves rests is at least so fine, for the levels of detail, and need not be finer
/// than the other where they are noise: that costs the same as a rest.
constexpr double kUsefulSteps = 1 << 12, kNoiseSteps = 1 << 24;

/// As many coordinates may leave a rest. More: what is left over could have been predicted. Fewer:
/// most coordinates would say again and again that their last digits are zero.
constexpr double kMostRests = 0.6;

/// A radix with the number of coordinates by the digits that they need.
struct Digits {
  uint32_t radix = 0;
  double bits = 0;    ///< log2(radix)
  int32_t least = 0;  ///< exponents to choose from
  int32_t most = 0;
  std::span<const uint64_t> counts;  ///< from `least` digits on
};

struct Choice {
  bool found = false;
  ExactStep step;
  double bits = 0;  ///< of lattice coordinates and rests, less what is the same for all choices
};

/// Coordinates that need more digits than `exponent`, and how many more they need together.
struct Beyond {
  double coordinates = 0;
  double digits = 0;
};
Beyond BeyondOf(const Digits& digits, int32_t exponent) {
  Beyond beyond;
  int32_t more = 0;
  for (uint64_t count : digits.counts.subspan(static_cast<size_t>(exponent + 1 - digits.least))) {
    beyond.coordinates += static_cast<double>(count);
    beyond.digits += static_cast<double>(count) * ++more;
  }
  return beyond;
}

Choice ChoiceOf(const Digits& digits, const CoordinateCensus& census) {
  const Bounds& box = census.bounds;
  double largest = 0;
  for (size_t i = 0; i < 3; ++i) {
    largest = std::max({largest, std::fabs(box.lo[i]), std::fabs(box.hi[i])});
  }
  const double coordinates = static_cast<double>(census.coordinates);
  Choice choice, noisy;
  for (int32_t exponent = digits.least; exponent <= digits.most; ++exponent) {
    const ExactStep step{digits.radix, exponent, false, true};
    const double steps = box.longest() / step.Unit();
    if (steps > kMostSteps || largest / step.Unit() > ExactLattice::kLargestWhole) break;
    const Beyond beyond = BeyondOf(digits, exponent);
    choice = {true, step, digits.bits * (coordinates * exponent + beyond.digits)};
    if (beyond.coordinates == 0) return choice;
    if (beyond.coordinates <= kMostRests * coordinates && steps >= kUsefulSteps) return choice;
    if (!noisy.found && steps >= kNoiseSteps) noisy = choice;
  }
  return noisy.found ? noisy : choice;
}

}  // namespace

Lattice ExactLatticeFor(const CoordinateCensus& census, bool is_float) {
  const Choice decimal =
      ChoiceOf({10, 3.321928094887362, 0, ExactStep::kMostDecimals, census.decimals}, census);
  const Choice binary =
      ChoiceOf({2, 1, ExactStep::kLeastBits, ExactStep::kMostBits, census.bits}, census);
  const bool is_decimal = decimal.found && (!binary.found || decimal.bits <= binary.bits);
  ExactLattice exact;
  exact.step = is_decimal ? decimal.step : binary.step;
  exact.step.is_float = is_float;
  Lattice lattice;
  lattice.unit = exact.step.Unit();
  for (size_t axis = 0; axis < 3; ++axis) {
    exact.first[axis] = WholeOf(exact.step, census.bounds.lo[axis]);
    const int64_t last = WholeOf(exact.step, census.bounds.hi[axis]);
    lattice.extent[axis] = static_cast<int32_t>(last - exact.first[axis]);
    lattice.origin[axis] = exact.step.Quotient(exact.first[axis], 0);
  }
  lattice.exact = exact;
  return lattice;
}

}  // namespace folprom
