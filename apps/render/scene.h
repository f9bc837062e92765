// A mesh that rays can be cast at.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "apps/render/camera.h"
#include "apps/render/float3.h"
#include "engine/measure/triangle_mesh.h"
#include "parallel/progress.h"
#include "parallel/runner.h"

struct RTCGeometryTy;

namespace folprom::measure {
class EmbreeScene;
}

namespace folprom::render {

/// A mesh in camera coordinates: its faces, or where none of them has an area, its vertices as
/// small spheres. What is not finite is left out. Thread-safe after construction.
class Scene {
 public:
  /// Throws std::bad_alloc, Cancelled, Failure kInternal.
  Scene(measure::TriangleMesh mesh, const Camera& camera, parallel::Runner& runner,
        const parallel::Progress& progress);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Most bytes that a mesh takes, from its reading to the finished scene.
  static uint64_t Bytes(uint64_t vertices, uint64_t faces);

  struct Hit {
    Float3 point;
    Float3 normal;  ///< of length 1, towards the eye
    uint32_t element = 0;
  };
  /// The first thing that a ray from the eye meets. Of two equally near the one of lower number, so
  /// that the hit depends on no order.
  std::optional<Hit> FirstHit(const Float3& direction) const;
  /// Whether anything lies between the surface of a hit and what is far off in this direction.
  bool Blocked(const Hit& hit, const Float3& direction) const;

  bool has_faces() const { return !faces_.empty(); }
  std::array<Float3, 3> CornersOf(uint32_t face) const;

  uint64_t vertices_left_out() const { return vertices_left_out_; }
  uint64_t faces_left_out() const { return faces_left_out_; }

 private:
  struct Sphere {
    Float3 centre;
    float radius;
  };
  struct Callbacks;
  void TakeMesh(measure::TriangleMesh mesh, const Camera& camera);
  void MakeSpheres(const std::vector<bool>& finite, const Camera& camera);
  RTCGeometryTy* MakeGeometry();

  std::vector<Float3> positions_;  ///< one more than there are, as Embree reads 16 bytes at once
  std::vector<std::array<uint32_t, 3>> faces_;
  std::vector<Sphere> spheres_;
  uint64_t vertices_left_out_ = 0, faces_left_out_ = 0;
  std::unique_ptr<measure::EmbreeScene> scene_;
};

}  // namespace folprom::render
