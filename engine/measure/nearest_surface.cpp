#include "engine/measure/nearest_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/measure/embree_scene.h"
#include "engine/measure/triangle_distance.h"

namespace folprom::measure {
namespace {

float RoundedDown(double x) {
  return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity());
}

float RoundedUp(double x) {
  return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity());
}

// One search. Embree knows the point as `query`; `rounding` is how far that lies from the point.
struct Search {
  const NearestSurface* surface;
  Vector3 point;
  double rounding;
  double squared;
  uint32_t element;

  // Never too small: covers the rounding of the point and of Embree's own arithmetic, a few units
  // in the last place of a float, and keeps the square above what float flushes to zero.
  float Radius() const { return RoundedUp((std::sqrt(squared) + rounding) * (1 + 1e-6) + 1e-12); }
};

}  // namespace

// What Embree calls back.
struct NearestSurface::Callbacks {
  static void Bounds(const RTCBoundsFunctionArguments* arguments) {
    EmbreeScene::TakeOver();
    const auto& mesh = *static_cast<const TriangleMesh*>(arguments->geometryUserPtr);
    Vector3 lo, hi;
    if (mesh.faces.empty()) {
      lo = hi = mesh.positions[arguments->primID];
    } else {
      const auto& face = mesh.faces[arguments->primID];
      lo = hi = mesh.positions[face[0]];
      for (const uint32_t vertex : face) {
        for (size_t i = 0; i < 3; ++i) {
          lo[i] = std::min(lo[i], mesh.positions[vertex][i]);
          hi[i] = std::max(hi[i], mesh.positions[vertex][i]);
        }
      }
    }
    RTCBounds& box = *arguments->bounds_o;
    box.lower_x = RoundedDown(lo[0]);
    box.lower_y = RoundedDown(lo[1]);
    box.lower_z = RoundedDown(lo[2]);
    box.upper_x = RoundedUp(hi[0]);
    box.upper_y = RoundedUp(hi[1]);
    box.upper_z = RoundedUp(hi[2]);
    EmbreeScene::HandOver();
  }

  static bool Visit(RTCPointQueryFunctionArguments* arguments) {
    auto& search = *static_cast<Search*>(arguments->userPtr);
    const double squared = search.surface->SquaredDistanceOf(arguments->primID, search.point);
    if (!(squared < search.squared)) return false;
    search.squared = squared;
    search.element = arguments->primID;
    arguments->query->radius = search.Radius();
    return true;
  }
};

NearestSurface::NearestSurface(const TriangleMesh& mesh, parallel::Runner& runner,
                               const parallel::Progress& progress)
    : mesh_(mesh), scene_(std::make_unique<EmbreeScene>()) {
  // Not triangles of Embree's own: it would round their corners, and leave some out.
  RTCGeometry geometry = rtcNewGeometry(scene_->device(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(element_count()));
  rtcSetGeometryUserData(geometry, const_cast<TriangleMesh*>(&mesh_));
  rtcSetGeometryBoundsFunction(geometry, &Callbacks::Bounds, nullptr);
  scene_->Build(geometry, runner, progress);
}

NearestSurface::~NearestSurface() = default;

size_t NearestSurface::element_count() const {
  return mesh_.faces.empty() ? mesh_.positions.size() : mesh_.faces.size();
}

double NearestSurface::SquaredDistanceOf(uint32_t element, const Vector3& point) const {
  if (mesh_.faces.empty()) {
    const Vector3 away = Difference(point, mesh_.positions[element]);
    return Dot(away, away);
  }
  const auto& face = mesh_.faces[element];
  return SquaredDistanceToTriangle(point, mesh_.positions[face[0]], mesh_.positions[face[1]],
                                   mesh_.positions[face[2]]);
}

double NearestSurface::DistanceOf(uint32_t element, const Vector3& point) const {
  return std::sqrt(SquaredDistanceOf(element, point));
}

NearestSurface::Nearest NearestSurface::From(const Vector3& point, uint32_t guess) const {
  RTCPointQuery query;
  query.x = static_cast<float>(point[0]);
  query.y = static_cast<float>(point[1]);
  query.z = static_cast<float>(point[2]);
  query.time = 0;
  const Vector3 rounded = {query.x, query.y, query.z};
  Search search = {this, point, Length(Difference(point, rounded)), SquaredDistanceOf(guess, point),
                   guess};
  query.radius = search.Radius();
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene_->get(), &query, &context, &Callbacks::Visit, &search);
  return {std::sqrt(search.squared), search.element};
}

}  // namespace folprom::measure
