// A mesh in memory, as the measurements need it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/measure/vector3.h"
#include "folprom/settings.h"
#include "parallel/progress.h"
#include "parallel/runner.h"

namespace folprom::measure {

struct TriangleMesh {
  std::vector<Vector3> positions;  ///< to be measured: at least one, all finite
  std::vector<std::array<uint32_t, 3>> faces;
};

/// Whether a file begins as a .folp file does, be it cut. Throws Failure kInput.
bool IsFolp(const std::string& path);

struct ReadOptions {
  DecodeOptions decode;  ///< of a .folp file; its temporary_folder holds the decoded mesh
  /// Also a mesh without vertices, and positions that are not finite.
  bool take_all = false;
  std::vector<std::string>* warnings = nullptr;  ///< takes those of the decoder, unless null
  /// Told the counts before anything is loaded; may throw. Empty: nobody is told.
  std::function<void(uint64_t vertices, uint64_t faces)> before_loading;
};

/// Reads a mesh file; a .folp file is decoded. Throws Failure, Cancelled.
TriangleMesh ReadMesh(const std::string& path, const ReadOptions& options, parallel::Runner& runner,
                      parallel::Progress& progress);

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
