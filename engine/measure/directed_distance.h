// Mean, root mean square and maximum of the distances from one surface to another.
#pragma once

#include "engine/measure/nearest_surface.h"
#include "engine/measure/surface_samples.h"
#include "folprom/measure.h"
#include "parallel/progress.h"
#include "parallel/runner.h"

namespace folprom::measure {

/// In units of the frame. Same result for every runner. `stage`: name for the progress, a literal.
/// Throws Cancelled.
DistanceStatistics DirectedDistance(const SurfaceSamples& from, const NearestSurface& to,
                                    const char* stage, parallel::Runner& runner,
                                    parallel::Progress& progress);

}  // namespace folprom::measure
