#include "engine/hierarchy/surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace folprom {
namespace {

using Eigen::Vector3d;

/// Sums over the faces around each vertex.
struct Accumulator {
  std::vector<Vector3d> area_normals;
  std::vector<Vector3d> unit_normals;
  std::vector<uint32_t> faces;

  explicit Accumulator(size_t vertices)
      : area_normals(vertices, Vector3d::Zero()),
        unit_normals(vertices, Vector3d::Zero()),
        faces(vertices, 0) {}

  void Add(uint32_t vertex, const Vector3d& area, const Vector3d& unit) {
    area_normals[vertex] += area;
    unit_normals[vertex] += unit;
    ++faces[vertex];
  }
};

Vector3d ToVector(const Int3& p) { return Vector3d(p.x, p.y, p.z); }

bool FaceNormal(const Int3& a, const Int3& b, const Int3& c, Vector3d* area, Vector3d* unit) {
  *area = (ToVector(b) - ToVector(a)).cross(ToVector(c) - ToVector(a));
  double length = area->norm();
  if (!(length > 0)) return false;
  *unit = *area / length;
  return true;
}

}  // namespace

SurfaceAttributes MeasureSurface(std::span<const Int3> positions, std::span<const Face> faces,
                                 std::span<const CrossFace> cross_faces, uint32_t subtree) {
  Accumulator sums(positions.size());
  Vector3d area, unit;
  for (const Face& face : faces) {
    if (!FaceNormal(positions[face[0]], positions[face[1]], positions[face[2]], &area, &unit)) {
      continue;
    }
    for (uint32_t vertex : face) sums.Add(vertex, area, unit);
  }
  for (const CrossFace& face : cross_faces) {
    if (!FaceNormal(face.position[0], face.position[1], face.position[2], &area, &unit)) continue;
    for (const VertexRef& vertex : face.vertex) {
      if (vertex.subtree == subtree) sums.Add(vertex.local, area, unit);
    }
  }
  SurfaceAttributes result;
  result.normals = std::move(sums.area_normals);
  result.curvature.assign(positions.size(), 0);
  result.areas.assign(positions.size(), 0);
  for (size_t i = 0; i < positions.size(); ++i) {
    double length = result.normals[i].norm();
    result.areas[i] = length / 6;
    if (length > 0) result.normals[i] /= length;
    if (sums.faces[i] == 0) continue;
    // For unit normals n_f of mean m the variance is 1 - |m|^2.
    double count = sums.faces[i];
    double variance = 1 - sums.unit_normals[i].squaredNorm() / (count * count);
    result.curvature[i] = std::sqrt(std::max(variance, 0.0));
  }
  return result;
}

}  // namespace folprom
