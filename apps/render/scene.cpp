#include "apps/render/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/measure/embree_scene.h"

namespace folprom::render {
namespace {

// Embree's tree while it is built, measured at 37 and 50 and rounded up.
constexpr uint64_t kTreeBytesPerFace = 48;
constexpr uint64_t kTreeBytesPerSphere = 80;

// A ray starts this far above the surface that it leaves.
constexpr float kLift = 2e-5F;

constexpr double kLargestSphere = 0.012;  ///< radius
constexpr double kLeastPixels = 0.7;      ///< radius of a sphere in the picture

// A ray that keeps the lowest number among equally near hits.
struct FirstHitContext {
  RTCIntersectContext base;  // Embree knows its address
  float distance = std::numeric_limits<float>::infinity();
  uint32_t element = std::numeric_limits<uint32_t>::max();
};

bool IsFinite(const Vector3& p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

bool HasArea(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 ab = measure::Difference(b, a), ac = measure::Difference(c, a);
  const Vector3 normal = measure::Cross(ab, ac);
  return measure::Dot(normal, normal) > 0;
}

// Points on a surface as large as two thirds of the box lie so far apart.
double Spacing(const Vector3& extent, size_t points) {
  const double area = extent[0] * extent[1] + extent[1] * extent[2] + extent[2] * extent[0];
  return std::sqrt(4.0 / 3 * area / static_cast<double>(points));
}

}  // namespace

// What Embree calls back.
struct Scene::Callbacks {
  static void KeepLowest(const RTCFilterFunctionNArguments* arguments) {
    if (arguments->valid[0] == 0) return;
    auto& context = *reinterpret_cast<FirstHitContext*>(arguments->context);
    const float distance = RTCRayN_tfar(arguments->ray, arguments->N, 0);
    const uint32_t element = RTCHitN_primID(arguments->hit, arguments->N, 0);
    if (distance == context.distance && element > context.element) {
      arguments->valid[0] = 0;
      return;
    }
    context.distance = distance;
    context.element = element;
  }
};

uint64_t Scene::Bytes(uint64_t vertices, uint64_t faces) {
  const uint64_t read = vertices * (sizeof(Vector3) + sizeof(Float3)) + faces * sizeof(faces_[0]);
  // Which of the two is drawn shows only later.
  return read + std::max(faces * kTreeBytesPerFace,
                         faces > 0 ? 0 : vertices * (sizeof(Sphere) + kTreeBytesPerSphere));
}

Scene::Scene(measure::TriangleMesh mesh, const Camera& camera, parallel::Runner& runner,
             const parallel::Progress& progress)
    : scene_(std::make_unique<measure::EmbreeScene>(static_cast<RTCSceneFlags>(
          static_cast<int>(RTC_SCENE_FLAG_ROBUST) | static_cast<int>(RTC_SCENE_FLAG_COMPACT)))) {
  TakeMesh(std::move(mesh), camera);
  scene_->Build(MakeGeometry(), runner, progress);
}

Scene::~Scene() = default;

void Scene::TakeMesh(measure::TriangleMesh mesh, const Camera& camera) {
  std::vector<bool> finite(mesh.positions.size());
  positions_.resize(mesh.positions.size() + 1);
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    finite[i] = IsFinite(mesh.positions[i]);
    if (finite[i]) {
      positions_[i] = camera.Inside(mesh.positions[i]);
    } else {
      ++vertices_left_out_;
    }
  }
  bool area = false;
  faces_left_out_ = std::erase_if(mesh.faces, [&](const auto& face) {
    if (!finite[face[0]] || !finite[face[1]] || !finite[face[2]]) return true;
    area =
        area || HasArea(mesh.positions[face[0]], mesh.positions[face[1]], mesh.positions[face[2]]);
    return false;
  });
  if (area) {
    faces_ = std::move(mesh.faces);
  } else {
    MakeSpheres(finite, camera);
  }
}

void Scene::MakeSpheres(const std::vector<bool>& finite, const Camera& camera) {
  const double least = kLeastPixels * camera.pixel() * camera.distance();
  const double radius =
      std::max(least, std::min(kLargestSphere, Spacing(camera.extent(), finite.size()) / 2));
  for (size_t i = 0; i < finite.size(); ++i) {
    if (finite[i]) spheres_.push_back({positions_[i], static_cast<float>(radius)});
  }
  positions_ = {};
}

RTCGeometryTy* Scene::MakeGeometry() {
  const bool triangles = has_faces();
  RTCGeometry geometry = rtcNewGeometry(
      scene_->device(), triangles ? RTC_GEOMETRY_TYPE_TRIANGLE : RTC_GEOMETRY_TYPE_SPHERE_POINT);
  if (triangles) {
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               positions_.data(), 0, sizeof(Float3), positions_.size() - 1);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, faces_.data(),
                               0, sizeof(faces_[0]), faces_.size());
  } else {
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                               spheres_.data(), 0, sizeof(Sphere), spheres_.size());
  }
  rtcSetGeometryIntersectFilterFunction(geometry, &Callbacks::KeepLowest);
  return geometry;
}

std::optional<Scene::Hit> Scene::FirstHit(const Float3& direction) const {
  FirstHitContext context;
  rtcInitIntersectContext(&context.base);
  RTCRayHit ray = {};
  ray.ray.dir_x = direction.x;
  ray.ray.dir_y = direction.y;
  ray.ray.dir_z = direction.z;
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.mask = ~0U;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene_->get(), &context.base, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  Float3 normal = Normalized({ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z});
  if (Dot(normal, direction) > 0) normal = -1 * normal;
  return Hit{ray.ray.tfar * direction, normal, ray.hit.primID};
}

bool Scene::Blocked(const Hit& hit, const Float3& direction) const {
  const Float3 from = hit.point + kLift * hit.normal;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = {};
  ray.org_x = from.x;
  ray.org_y = from.y;
  ray.org_z = from.z;
  ray.dir_x = direction.x;
  ray.dir_y = direction.y;
  ray.dir_z = direction.z;
  ray.tfar = std::numeric_limits<float>::infinity();
  ray.mask = ~0U;
  rtcOccluded1(scene_->get(), &context, &ray);
  return ray.tfar < 0;
}

std::array<Float3, 3> Scene::CornersOf(uint32_t face) const {
  const auto& corners = faces_[face];
  return {positions_[corners[0]], positions_[corners[1]], positions_[corners[2]]};
}

}  // namespace folprom::render
