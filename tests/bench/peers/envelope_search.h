// The best that "simplify, then Draco" gives at a rate: over face counts and position bits.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "folprom/measure.h"
#include "parallel/progress.h"
#include "parallel/runner.h"

namespace folprom::peers {

struct EnvelopePoint {
  double requested = 0;        ///< bits per vertex of the original
  double bits_per_vertex = 0;  ///< reached, never above
  uint64_t bytes = 0;
  int position_bits = 0;
  uint64_t vertices = 0, faces = 0;  ///< that were encoded
  DistanceStatistics error;          ///< larger of the two directions, parts of the diagonal
};

struct Envelope {
  uint64_t vertices = 0, faces = 0;   ///< of the original
  uint64_t samples = 0;               ///< as in Comparison
  std::vector<EnvelopePoint> points;  ///< rates that nothing fits into are left out
};

/// For each rate and each number of position bits the largest mesh whose file fits, then the one of
/// these with the smallest mean error. `samples`: 0 for the default of CompareFiles; the search
/// itself makes do with fewer. Progress goes to standard error. Throws Failure, Cancelled.
Envelope SearchEnvelope(const std::string& scan, std::span<const double> rates, uint64_t samples,
                        parallel::Runner& runner, parallel::Progress& progress);

}  // namespace folprom::peers
