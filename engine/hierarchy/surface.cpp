#include "engine/hierarchy/surface.h"

#include <algorithm>
#include <cmath>

namespace folprom {
namespace {

/// Sums over the faces around each vertex.
struct Accumulator {
  std::vector<Vector3> area_normals;
  std::vector<Vector3> unit_normals;
  std::vector<uint32_t> faces;

  explicit Accumulator(size_t vertices)
      : area_normals(vertices, Vector3{0, 0, 0}),
        unit_normals(vertices, Vector3{0, 0, 0}),
        faces(vertices, 0) {}

  void Add(uint32_t vertex, const Vector3& area, const Vector3& unit) {
    for (size_t i = 0; i < 3; ++i) {
      area_normals[vertex][i] = area_normals[vertex][i] + area[i];
      unit_normals[vertex][i] = unit_normals[vertex][i] + unit[i];
    }
    ++faces[vertex];
  }
};

bool FaceNormal(const Int3& a, const Int3& b, const Int3& c, Vector3* area, Vector3* unit) {
  *area = Cross(Difference(b, a), Difference(c, a));
  double length = std::sqrt(Dot(*area, *area));
  if (!(length > 0)) return false;
  for (size_t i = 0; i < 3; ++i) (*unit)[i] = (*area)[i] / length;
  return true;
}

}  // namespace

SurfaceAttributes MeasureSurface(std::span<const Int3> positions, std::span<const Face> faces,
                                 std::span<const CrossFace> cross_faces, uint32_t subtree) {
  Accumulator sums(positions.size());
  Vector3 area, unit;
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
  for (size_t i = 0; i < positions.size(); ++i) {
    Vector3& normal = result.normals[i];
    double length = std::sqrt(Dot(normal, normal));
    for (double& value : normal) value = length > 0 ? value / length : 0;
    if (sums.faces[i] == 0) continue;
    // For unit normals n_f of mean m the variance is 1 - |m|^2.
    double count = sums.faces[i];
    double variance = 1 - Dot(sums.unit_normals[i], sums.unit_normals[i]) / (count * count);
    result.curvature[i] = std::sqrt(std::max(variance, 0.0));
  }
  return result;
}

}  // namespace folprom
