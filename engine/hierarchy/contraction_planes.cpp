// What a ContractionMesh measures before it shrinks: planes of faces and of open edges, and how the
// surface bends.
#include <cmath>

#include "engine/hierarchy/contraction_mesh.h"

namespace folprom {
namespace {

/// Planes through open edges, perpendicular to the face, weigh this much more than the face.
constexpr double kBoundaryWeight = 4;
/// Where so many of the vertices lie flat and so many on edges, there are faces and edges.
constexpr double kFlatShare = 0.3, kSharpShare = 0.02;
/// How far from a plane its points come to lie on the lattice, and twice the mean area of faces
/// whose angles that leaves alone.
constexpr double kRounding = 1, kLeastMeasured = 400;
/// Length of the sum of a vertex's face normals over their areas below which an edge goes through.
constexpr double kSharpNormals = 0.97;

double Length(const Vector3& a) { return std::sqrt(Dot(a, a)); }

}  // namespace

Vector3 ContractionMesh::AreaNormal(uint32_t a, uint32_t b, uint32_t c) const {
  const Int3& origin = vertices_[a].position;
  return Cross(Difference(vertices_[b].position, origin),
               Difference(vertices_[c].position, origin));
}

void ContractionMesh::AddFacePlanes() {
  const double unit = static_cast<double>(scale_) * static_cast<double>(scale_);
  for (const Face& face : faces_) {
    Vector3 normal = AreaNormal(face[0], face[1], face[2]);
    const double length = Length(normal);
    if (!(length > 0)) continue;
    for (double& value : normal) value = value / length;
    for (uint32_t v : face) {
      if (v < own_) vertices_[v].quadric.AddPlane(normal, length / 6 * unit);
    }
  }
}

void ContractionMesh::AddBoundaryPlane(uint32_t a, uint32_t b, const Face& face) {
  const Vector3 along = Difference(vertices_[b].position, vertices_[a].position);
  Vector3 normal = Cross(AreaNormal(face[0], face[1], face[2]), along);
  const double length = Length(normal);
  if (!(length > 0)) return;
  for (double& value : normal) value = value / length;
  const double unit = static_cast<double>(scale_) * static_cast<double>(scale_);
  const double weight = kBoundaryWeight * Dot(along, along) / 6 * unit;
  vertices_[a].quadric.AddPlane(normal, weight);
  vertices_[b].quadric.AddPlane(normal, weight);
}

void ContractionMesh::AddBoundaryPlanes() {
  struct Edge {
    uint32_t to, face, count;
  };
  std::vector<Edge> edges;
  for (uint32_t v = 0; v < own_; ++v) {
    // Foreign ends have a number per face, so their edges would all seem open.
    edges.clear();
    const uint32_t first_stamp = stamp_ + 1;
    for (uint32_t f : stars_.Of(v)) {
      for (size_t i = 0; i < 3; ++i) {
        const uint32_t a = faces_[f][i], b = faces_[f][(i + 1) % 3];
        if ((a != v) == (b != v)) continue;
        const uint32_t w = a == v ? b : a;
        if (w < v || w >= own_) continue;
        uint32_t& stamp = vertices_[w].stamp;
        if (stamp < first_stamp) {
          stamp = ++stamp_;
          edges.push_back({w, f, 0});
        }
        ++edges[stamp - first_stamp].count;
      }
    }
    for (const Edge& edge : edges) {
      if (edge.count != 1) continue;
      AddBoundaryPlane(v, edge.to, faces_[edge.face]);
      for (const uint32_t end : {v, edge.to}) rims_[end] |= kOpenEdge;
    }
  }
}

bool ContractionMesh::HasFacesAndEdges() const {
  uint32_t flat = 0, sharp = 0;
  for (uint32_t v = 0; v < own_; ++v) {
    const Bend bend = BendAt(v);
    flat += bend == Bend::kFlat ? 1 : 0;
    sharp += bend == Bend::kSharp ? 1 : 0;
  }
  return flat > kFlatShare * own_ && sharp > kSharpShare * own_;
}

/// Flat: all of the vertex's faces lie in one plane but for the rounding to the lattice.
ContractionMesh::Bend ContractionMesh::BendAt(uint32_t v) const {
  const auto star = stars_.Of(v);
  Vector3 normal{0, 0, 0};
  double area = 0;
  for (uint32_t f : star) {
    const Vector3 face_normal = AreaNormal(faces_[f][0], faces_[f][1], faces_[f][2]);
    for (size_t i = 0; i < 3; ++i) normal[i] = normal[i] + face_normal[i];
    area = area + Length(face_normal);
  }
  const double length = Length(normal);
  if (star.empty() || area < kLeastMeasured * static_cast<double>(star.size())) {
    return Bend::kSmooth;
  }
  if (length < kSharpNormals * area) return Bend::kSharp;
  for (uint32_t f : star) {
    for (uint32_t corner : faces_[f]) {
      const Vector3 d = Difference(vertices_[corner].position, vertices_[v].position);
      if (std::fabs(Dot(d, normal)) > kRounding * length) return Bend::kSmooth;
    }
  }
  return Bend::kFlat;
}

}  // namespace folprom
