// Pass 0 of an exact encoding: what has to be known of all coordinates to choose their lattice.
#pragma once

#include <array>
#include <cstdint>

#include "engine/mesh/exact_lattice.h"
#include "engine/mesh/lattice.h"
#include "io/formats/mesh_source.h"
#include "parallel/progress.h"
#include "parallel/runner.h"

namespace folprom {

/// Counts over the coordinates that are tame (IsTame); the others count in no other field.
struct CoordinateCensus {
  static constexpr int32_t kLeastBits = ExactStep::kLeastBits, kMostBits = ExactStep::kMostBits;

  Bounds bounds;
  uint64_t coordinates = 0;
  /// By the decimals that the coordinate needs (DecimalsOf); the last for what has none.
  std::array<uint64_t, ExactStep::kMostDecimals + 2> decimals{};
  /// By its bits behind the binary point, from kLeastBits on (FractionBitsOf); zeros in the first.
  std::array<uint64_t, kMostBits - kLeastBits + 1> bits{};
};

CoordinateCensus TakeCensus(const io::MeshSource& source, bool is_float, parallel::Runner& runner,
                            parallel::Progress& progress);

/// Does any coordinate not lie on the exact lattice.
bool HasRests(const io::MeshSource& source, const Lattice& lattice, parallel::Runner& runner,
              parallel::Progress& progress);

}  // namespace folprom
