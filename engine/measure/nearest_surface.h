// The nearest point of a surface, found by Embree and measured in double.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "engine/measure/triangle_mesh.h"

namespace folprom::measure {

class EmbreeScene;

/// The surface of a mesh: its faces, or its vertices where it has no face. Thread-safe after
/// construction. Keeps a reference to the mesh, which lies in a UnitFrame.
class NearestSurface {
 public:
  /// Builds the search tree on the threads of the runner. Throws std::bad_alloc, Cancelled.
  NearestSurface(const TriangleMesh& mesh, parallel::Runner& runner,
                 const parallel::Progress& progress);
  ~NearestSurface();
  NearestSurface(const NearestSurface&) = delete;
  NearestSurface& operator=(const NearestSurface&) = delete;

  struct Nearest {
    double distance = 0;   ///< in units of the frame
    uint32_t element = 0;  ///< a face or vertex that has it
  };
  /// Exact up to the rounding of doubles; the distance does not depend on the guess. A guess that
  /// lies near makes it fast; 0 will do.
  Nearest From(const Vector3& point, uint32_t guess) const;

  /// Distance of one face or vertex.
  double DistanceOf(uint32_t element, const Vector3& point) const;

 private:
  size_t element_count() const;
  double SquaredDistanceOf(uint32_t element, const Vector3& point) const;
  struct Callbacks;

  const TriangleMesh& mesh_;
  std::unique_ptr<EmbreeScene> scene_;
};

}  // namespace folprom::measure
