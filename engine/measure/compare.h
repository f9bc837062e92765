// An original that any number of meshes are compared with: read, sampled and indexed once.
#pragma once

#include <memory>
#include <string>

#include "engine/measure/nearest_surface.h"
#include "engine/measure/surface_samples.h"
#include "engine/measure/triangle_mesh.h"
#include "folprom/measure.h"
#include "parallel/progress.h"
#include "parallel/runner.h"

namespace folprom::measure {

/// Samples for a mesh of so many faces where nobody says how many: ten a face, as METRO takes, but
/// 500,000 .. 10,000,000.
uint64_t DefaultSamples(uint64_t faces);

/// Methods throw Failure and Cancelled.
class Original {
 public:
  /// `path`: for messages.
  Original(TriangleMesh mesh, const std::string& path, parallel::Runner& runner,
           parallel::Progress& progress);

  uint64_t face_count() const { return mesh_.faces.size(); }

  /// `samples`: on the area of each of the two surfaces, at least 1.
  Comparison Against(TriangleMesh other, const std::string& path, uint64_t samples);

 private:
  parallel::Runner& runner_;
  parallel::Progress& progress_;
  const UnitFrame frame_;
  const TriangleMesh mesh_;  ///< in the frame
  const NearestSurface nearest_;
  std::unique_ptr<SurfaceSamples> samples_;
  uint64_t sample_count_ = 0;
};

}  // namespace folprom::measure
