// What one setting of the coder costs and gives on one scan.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/codec/subtree_coder.h"
#include "folprom/measure.h"
#include "parallel/runner.h"

namespace folprom::bench {

/// Bits under the coder's own contexts, and entropies of the same values for a plain arithmetic
/// coder: frequencies known, no context but the place of a pivot flag in its order.
struct Costs {
  uint64_t vertices = 0;
  CostMeters meters;
  OffsetTally offsets;
  SplitTally flags;
};

/// Encodes every subtree; the seams are left out. Throws Failure.
Costs CostsOf(const std::string& scan, const EncodeOptions& options, parallel::Runner& runner);

/// Distances in 1e-4 of the diagonal, the larger of both directions, at the rate of each layer.
struct Curve {
  struct Point {
    double bits_per_vertex, mean, rms;
  };
  std::vector<Point> points;  ///< rates ascend

  /// Between two layers log(error) is linear in log(rate), unless they are more than an octave
  /// apart: then, and behind the last one, it is that of the layer before. Nothing before the
  /// first.
  std::optional<double> At(double bits_per_vertex, double Point::*error) const;
};

/// Decodes and compares up to four layers an octave of the rate from `lowest` to `highest`. Throws
/// Failure.
Curve CurveOf(const std::string& scan, const EncodeOptions& options, double lowest, double highest,
              parallel::Runner& runner);

}  // namespace folprom::bench
