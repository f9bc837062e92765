// How fine the lattice of a scan is.
#pragma once

#include "engine/mesh/lattice.h"
#include "folprom/scalar_type.h"
#include "folprom/settings.h"

namespace folprom {

/// Lattice and tolerance of a scan.
struct Resolution {
  Lattice lattice;
  double tolerance = 0;  ///< asked for, model units per axis
};

/// Throws Failure kUsage where the tolerance is finer than the lattice can be.
Resolution ResolutionOf(const Bounds& bounds, ScalarType type, const EncodeOptions& options);

/// Type in which decoded coordinates are written.
ScalarType OutputType(ScalarType input);

}  // namespace folprom
