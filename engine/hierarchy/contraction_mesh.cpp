#include "engine/hierarchy/contraction_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace folprom {
namespace {

/// Of a subtree from its first vertex in scaled units: so floats hold areas times squared lengths.
constexpr float kMostReach = 8192;
/// A vertex at the border to another subtree that would go inside costs so many times more: along
/// it neighbours keep half rings that are even, and what joins them to those beyond is told sooner.
constexpr float kBorderFactor = 16;
/// Of a hub, a vertex with a larger star, nobody asks whether rims meet: each of its spokes would
/// go through all of it.
constexpr uint32_t kMostLookedAt = 4096;
/// Square of the cosine by which a face may turn.
constexpr float kMostTurn = 0.04F;

using Offset = Quadric::Offset;

float Dot(const Offset& a, const Offset& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
bool IsCollapsed(const Face& face) {
  return face[0] == face[1] || face[1] == face[2] || face[0] == face[2];
}
Offset Cross(const Offset& a, const Offset& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double Length(const Vector3& a) { return std::sqrt(folprom::Dot(a, a)); }

}  // namespace

ContractionMesh::ContractionMesh(std::span<const Int3> positions, std::span<const Face> faces,
                                 std::span<const CrossFace> cross_faces, uint32_t subtree)
    : own_(static_cast<uint32_t>(positions.size())) {
  vertices_.reserve(positions.size() + 2 * cross_faces.size());
  faces_.reserve(faces.size() + cross_faces.size());
  for (const Int3& p : positions) AddPoint(p);
  faces_.assign(faces.begin(), faces.end());
  for (const CrossFace& cross : cross_faces) {
    Face face;
    for (size_t i = 0; i < 3; ++i) {
      face[i] = cross.vertex[i].local;
      if (cross.vertex[i].subtree != subtree) face[i] = AddPoint(cross.position[i]);
    }
    faces_.push_back(face);
  }
  ChooseScale(positions);
  LinkStars();
  AddFacePlanes();
  AddBoundaryPlanes();
}

uint32_t ContractionMesh::AddPoint(const Int3& p) {
  const uint32_t index = static_cast<uint32_t>(vertices_.size());
  vertices_.push_back({p, index, 0, {}});
  return index;
}

void ContractionMesh::ChooseScale(std::span<const Int3> positions) {
  int32_t reach = 0;
  for (const Int3& p : positions) {
    for (uint32_t i = 0; i < 3; ++i) {
      reach = std::max(reach, std::abs(At(p, i) - At(positions[0], i)));
    }
  }
  while (static_cast<float>(reach) * scale_ > kMostReach) scale_ = scale_ / 2;
}

uint32_t ContractionMesh::Find(uint32_t v) {
  while (vertices_[v].merged_into != v) {
    const uint32_t next = vertices_[v].merged_into;
    vertices_[v].merged_into = vertices_[next].merged_into;
    v = vertices_[v].merged_into;
  }
  return v;
}

ContractionMesh::Offset ContractionMesh::From(uint32_t a, uint32_t b) const {
  const Int3 &p = vertices_[a].position, &q = vertices_[b].position;
  return {static_cast<float>(q.x - p.x) * scale_, static_cast<float>(q.y - p.y) * scale_,
          static_cast<float>(q.z - p.z) * scale_};
}

double ContractionMesh::Distance(uint32_t a, uint32_t b) const {
  return Length(Difference(vertices_[a].position, vertices_[b].position));
}

void ContractionMesh::LinkStars() {
  for (uint32_t v = 0; v < own_; ++v) stars_.AddList();
  rims_.assign(own_, 0);
  for (uint32_t f = 0; f < faces_.size(); ++f) {
    const bool is_foreign = !IsOwn(faces_[f]);
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t v = faces_[f][i];
      // A corner may be in a face twice.
      if (v < own_ && v != faces_[f][(i + 1) % 3]) stars_.Append(v, f);
      if (v < own_ && is_foreign) rims_[v] = kBorder;
    }
  }
}

void ContractionMesh::PrefetchFaces(uint32_t v) const {
  for (const uint32_t f : stars_.Of(v)) __builtin_prefetch(&faces_[f]);
}

void ContractionMesh::PrefetchCorners(uint32_t v) const {
  for (const uint32_t f : stars_.Of(v)) {
    for (const uint32_t corner : faces_[f]) __builtin_prefetch(&vertices_[corner]);
  }
}

/// Faces that have collapsed to an edge stay in the star only while no other face of it joins v to
/// the same neighbour.
std::span<const uint32_t> ContractionMesh::CollectRing(uint32_t v) {
  const uint32_t size = stars_.SizeOf(v);
  if (ring_.size() < size_t{3} * size) ring_.resize(size_t{3} * size);
  ring_size_ = 0;
  collapsed_.clear();
  vertices_[v].stamp = ++stamp_;
  uint32_t kept = 0;
  for (uint32_t i = 0; i < size; ++i) {
    const uint32_t f = stars_.At(v, i);
    for (uint32_t& corner : faces_[f]) corner = Find(corner);
    const auto [a, b, c] = faces_[f];
    if (IsCollapsed(faces_[f])) {
      if (a != b || b != c) collapsed_.push_back(f);
      continue;
    }
    stars_.At(v, kept++) = f;
    for (uint32_t w : {a, b, c}) AddToRing(w);
  }
  for (uint32_t f : collapsed_) {
    const uint32_t before = ring_size_;
    for (uint32_t corner : faces_[f]) AddToRing(corner);
    if (ring_size_ > before) stars_.At(v, kept++) = f;
  }
  stars_.Shrink(v, kept);
  return Ring();
}

/// Unless it was met before. Who was is as good as random: no branch goes by it.
void ContractionMesh::AddToRing(uint32_t w) {
  uint32_t& stamp = vertices_[w].stamp;
  const bool is_new = stamp != stamp_ && w < own_;
  stamp = stamp_;
  ring_[ring_size_] = w;
  ring_size_ += is_new ? 1 : 0;
}

float ContractionMesh::CostOf(uint32_t v, uint32_t target, float length_weight) const {
  const Offset offset = From(v, target);
  const Quadric& own = vertices_[v].quadric;
  const float error = own.At(offset) + vertices_[target].quadric.constant;
  const float cost = error + length_weight * own.weight * Dot(offset, offset);
  return LeavesBorder(v, target) ? kBorderFactor * cost : cost;
}

bool ContractionMesh::IsAllowed(uint32_t v, uint32_t target) {
  uint32_t shared = 0;
  for (uint32_t f : stars_.Of(v)) {
    const Face& face = faces_[f];
    if (IsCollapsed(face)) continue;
    if (face[0] == target || face[1] == target || face[2] == target) {
      ++shared;
      continue;
    }
    const size_t place = face[0] == v ? 0 : (face[1] == v ? 1 : 2);
    const uint32_t next = face[(place + 1) % 3], previous = face[(place + 2) % 3];
    const Offset side = From(next, previous);
    const Offset before = Cross(side, From(next, v)), after = Cross(side, From(next, target));
    const float agreement = Dot(before, after);
    const float limit = kMostTurn * Dot(before, before) * Dot(after, after);
    if (agreement < 0 || agreement * agreement < limit) return false;
  }
  // The link condition: common neighbours lie on faces of the edge.
  return CommonNeighbours(target) <= shared;
}

bool ContractionMesh::PinchesRims(uint32_t v, uint32_t target) {
  if (rims_[v] == 0 || rims_[target] == 0 || stars_.SizeOf(target) > kMostLookedAt) return false;
  uint32_t own = 0, shared = 0;
  for (uint32_t f : stars_.Of(v)) {
    const Face& face = faces_[f];
    if (IsCollapsed(face) || !IsOwn(face)) continue;
    ++own;
    shared += std::find(face.begin(), face.end(), target) != face.end() ? 1 : 0;
  }
  return shared > 1 && own < ring_size_ && IsOpen(target);
}

bool ContractionMesh::IsOpen(uint32_t v) {
  uint32_t faces = 0, neighbours = 0;
  vertices_[v].stamp = ++stamp_;
  for (uint32_t f : stars_.Of(v)) {
    for (uint32_t& corner : faces_[f]) corner = Find(corner);
    if (IsCollapsed(faces_[f]) || !IsOwn(faces_[f])) continue;
    ++faces;
    for (uint32_t w : faces_[f]) {
      neighbours += vertices_[w].stamp != stamp_ ? 1 : 0;
      vertices_[w].stamp = stamp_;
    }
  }
  return faces < neighbours;
}

/// How many vertices of the ring are neighbours of target; looks through whichever stars are
/// smaller, since a hub's is looked at once for each of its spokes.
uint32_t ContractionMesh::CommonNeighbours(uint32_t target) {
  uint32_t common = 0;
  size_t around = 0;
  for (uint32_t w : Ring()) around += w != target ? stars_.SizeOf(w) : 0;
  if (around < stars_.SizeOf(target)) {
    for (uint32_t w : Ring()) common += w != target && AreNeighbours(w, target) ? 1 : 0;
    return common;
  }
  const uint32_t first = ++stamp_, second = ++stamp_;
  for (uint32_t w : Ring()) vertices_[w].stamp = first;
  for (uint32_t f : stars_.Of(target)) {
    for (uint32_t& corner : faces_[f]) {
      corner = Find(corner);
      if (corner >= own_ || vertices_[corner].stamp != first) continue;
      vertices_[corner].stamp = second;
      if (corner != target) ++common;
    }
  }
  return common;
}

bool ContractionMesh::AreNeighbours(uint32_t v, uint32_t other) {
  for (uint32_t f : stars_.Of(v)) {
    for (uint32_t corner : faces_[f]) {
      if (Find(corner) == other) return true;
    }
  }
  return false;
}

double ContractionMesh::Contract(uint32_t v, uint32_t target) {
  Vertex &gone = vertices_[v], &kept = vertices_[target];
  const Quadric& own = gone.quadric;
  const double error =
      own.weight > 0 ? std::sqrt(static_cast<double>(own.At(From(v, target)) / own.weight)) : 0;
  gone.merged_into = target;
  rims_[target] |= rims_[v];
  kept.quadric.Add(own, From(target, v));
  if (stars_.SizeOf(target) < stars_.SizeOf(v)) stars_.Swap(target, v);
  stars_.MoveAll(v, target);
  return error / static_cast<double>(scale_);
}

}  // namespace folprom
