// A mesh in memory, as the measurements need it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/measure/vector3.h"
#include "parallel/progress.h"
#include "parallel/runner.h"

namespace folprom::measure {

struct TriangleMesh {
  std::vector<Vector3> positions;  ///< at least one, all finite
  std::vector<std::array<uint32_t, 3>> faces;
};

/// Reads a mesh file; a .folp file, known by its first bytes, is decoded. Throws Failure,
/// Cancelled.
TriangleMesh ReadMesh(const std::string& path, const std::string& temporary_folder,
                      parallel::Runner& runner, parallel::Progress& progress);

/// Maps the bounding box of a mesh to one around the origin with a diagonal of length 1, so that
/// floats resolve it wherever it lies.
class UnitFrame {
 public:
  /// Throws Failure kInput where the box is larger than a double can tell. `path` is for messages.
  UnitFrame(const TriangleMesh& mesh, const std::string& path);

  /// Model units; 0 where all vertices coincide.
  double diagonal() const { return diagonal_; }
  /// Length 1 of the frame in model units.
  double scale() const { return diagonal_ > 0 ? diagonal_ : 1; }
  /// The mesh in the frame. Throws Failure kInput where it lies too far away for floats.
  TriangleMesh Inside(TriangleMesh mesh, const std::string& path) const;

 private:
  Vector3 centre_{};
  double diagonal_ = 0;
};

}  // namespace folprom::measure
