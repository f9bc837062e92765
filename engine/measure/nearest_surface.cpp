#include "engine/measure/nearest_surface.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>

#include "engine/measure/triangle_distance.h"
#include "folprom/result.h"

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

#if defined(__SANITIZE_THREAD__)
/// Repeats, where the thread sanitizer sees it, the order in which oneTBB hands the mesh to
/// Embree's threads and back.
std::atomic<uint32_t> order_of_handover{0};
void HandOver() { order_of_handover.fetch_add(1, std::memory_order_release); }
void TakeOver() { static_cast<void>(order_of_handover.load(std::memory_order_acquire)); }
#else
void HandOver() {}
void TakeOver() {}
#endif

}  // namespace

void NearestSurface::ReleaseDevice::operator()(RTCDeviceTy* device) const {
  rtcReleaseDevice(device);
}

void NearestSurface::ReleaseScene::operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }

// What Embree calls back.
struct NearestSurface::Callbacks {
  static void Bounds(const RTCBoundsFunctionArguments* arguments) {
    TakeOver();
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
    HandOver();
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

  static bool GoOn(void* progress, double) {
    try {
      static_cast<const parallel::Progress*>(progress)->ThrowIfCancelled();
    } catch (const parallel::Cancelled&) {
      return false;
    }
    return true;
  }
};

NearestSurface::NearestSurface(const TriangleMesh& mesh, parallel::Runner& runner,
                               const parallel::Progress& progress)
    : mesh_(mesh), device_(rtcNewDevice(nullptr)) {
  if (!device_) throw Failure(ErrorKind::kInternal, "Embree does not start");
  scene_.reset(rtcNewScene(device_.get()));
  auto* watched = const_cast<parallel::Progress*>(&progress);  // Embree hands on a void*.
  rtcSetSceneProgressMonitorFunction(scene_.get(), &Callbacks::GoOn, watched);
  Build(runner);
  progress.ThrowIfCancelled();
  const RTCError error = rtcGetDeviceError(device_.get());
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  if (error != RTC_ERROR_NONE) {
    throw Failure(ErrorKind::kInternal, "Embree fails with error " + std::to_string(error));
  }
}

NearestSurface::~NearestSurface() = default;

void NearestSurface::Build(parallel::Runner& runner) {
  // Not triangles of Embree's own: it would round their corners, and leave some out.
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(element_count()));
  rtcSetGeometryUserData(geometry, const_cast<TriangleMesh*>(&mesh_));
  rtcSetGeometryBoundsFunction(geometry, &Callbacks::Bounds, nullptr);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
  // Embree works with oneTBB, in the arena of its caller: inside a task, that of the runner. A
  // number of threads given to Embree itself would bind the whole process.
  HandOver();
  runner.ForEach(1, [&](size_t) { rtcCommitScene(scene_.get()); });
  TakeOver();
}

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
  rtcPointQuery(scene_.get(), &query, &context, &Callbacks::Visit, &search);
  return {std::sqrt(search.squared), search.element};
}

}  // namespace folprom::measure
