#include "engine/measure/surface_samples.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace folprom::measure {
namespace {

// Fixed, since sums are taken per block.
constexpr uint64_t kBlock = 8192;

size_t BlockCount(uint64_t items) { return static_cast<size_t>((items + kBlock - 1) / kBlock); }

// SplitMix64 of a number, as a fraction in [0, 1).
double Hashed(uint64_t number) {
  uint64_t z = (number + 1) * 0x9e3779b97f4a7c15;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

double Fraction(double x) { return x - std::floor(x); }

}  // namespace

SurfaceSamples::SurfaceSamples(const TriangleMesh& mesh, uint64_t count)
    : mesh_(mesh), count_(count) {
  CollectVertices();
  SumAreas();
  CollectEdges();
}

void SurfaceSamples::CollectVertices() {
  if (mesh_.faces.empty()) {
    vertices_.resize(mesh_.positions.size());
    std::iota(vertices_.begin(), vertices_.end(), 0u);
    return;
  }
  std::vector<bool> used(mesh_.positions.size());
  for (const auto& face : mesh_.faces) {
    for (const uint32_t vertex : face) used[vertex] = true;
  }
  for (uint32_t vertex = 0; vertex < used.size(); ++vertex) {
    if (used[vertex]) vertices_.push_back(vertex);
  }
}

void SurfaceSamples::SumAreas() {
  area_before_.reserve(mesh_.faces.size() + 1);
  double sum = 0;
  area_before_.push_back(sum);
  for (const auto& face : mesh_.faces) {
    const Vector3& a = mesh_.positions[face[0]];
    sum += Length(Cross(Difference(mesh_.positions[face[1]], a),
                        Difference(mesh_.positions[face[2]], a))) /
           2;
    area_before_.push_back(sum);
  }
  if (!(sum > 0)) area_before_.clear();
}

void SurfaceSamples::CollectEdges() {
  std::vector<uint64_t> keys;
  keys.reserve(3 * mesh_.faces.size());
  for (const auto& face : mesh_.faces) {
    for (size_t i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(face[i], face[(i + 1) % 3]);
      if (a != b) keys.push_back(uint64_t{a} << 32 | b);
    }
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  edges_.reserve(keys.size());
  double length = 0;
  for (const uint64_t key : keys) {
    edges_.push_back({static_cast<uint32_t>(key >> 32), static_cast<uint32_t>(key)});
    length += EdgeLength(edges_.back());
  }
  if (!(length > 0)) return;
  // As dense along an edge as on the area, as METRO has it; never more than on the area in all.
  samples_per_length_ = static_cast<double>(count_) / length;
  if (has_area()) {
    samples_per_length_ =
        std::min(samples_per_length_, std::sqrt(static_cast<double>(count_) / area_before_.back()));
  }
}

double SurfaceSamples::EdgeLength(const Edge& edge) const {
  return Length(Difference(mesh_.positions[edge.b], mesh_.positions[edge.a]));
}

size_t SurfaceSamples::area_blocks() const { return BlockCount(area_count()); }
size_t SurfaceSamples::vertex_blocks() const { return BlockCount(vertices_.size()); }
size_t SurfaceSamples::edge_blocks() const { return BlockCount(edges_.size()); }

uint64_t SurfaceSamples::FirstSampleOf(size_t face) const {
  return static_cast<uint64_t>(static_cast<double>(count_) * area_before_[face] /
                               area_before_.back());
}

// Points of one face follow each other in the additive sequence of the plastic number, which covers
// the unit square evenly however many are taken; the half beyond the diagonal is folded back.
Vector3 SurfaceSamples::PointOfFace(size_t face, uint64_t index) const {
  constexpr double kStepS = 0.7548776662466927;
  constexpr double kStepT = 0.5698402909980532;
  const auto i = static_cast<double>(index);
  double s = Fraction(Hashed(2 * face) + i * kStepS);
  double t = Fraction(Hashed(2 * face + 1) + i * kStepT);
  if (s + t > 1) {
    s = 1 - s;
    t = 1 - t;
  }
  const auto& corners = mesh_.faces[face];
  const Vector3& a = mesh_.positions[corners[0]];
  return Combination(a, s, Difference(mesh_.positions[corners[1]], a), t,
                     Difference(mesh_.positions[corners[2]], a));
}

void SurfaceSamples::FillAreaBlock(size_t block, std::vector<Vector3>* points) const {
  if (!has_area()) return FillVertexBlock(block, points);
  points->clear();
  const uint64_t begin = block * kBlock;
  const uint64_t end = std::min(begin + kBlock, count_);
  // Sample k stands for the k-th of equal shares of the area and lies, hashed, anywhere within it:
  // a fixed place would see only every second face of a regular mesh.
  const double share = area_before_.back() / static_cast<double>(count_);
  size_t face = 0;
  for (uint64_t k = begin; k < end; ++k) {
    const double at = (static_cast<double>(k) + Hashed(~k)) * share;
    if (k == begin) {
      const auto above = std::upper_bound(area_before_.begin(), area_before_.end(), at);
      face = static_cast<size_t>(above - area_before_.begin()) - 1;
    }
    while (face + 1 < mesh_.faces.size() && area_before_[face + 1] <= at) ++face;
    face = std::min(face, mesh_.faces.size() - 1);
    points->push_back(PointOfFace(face, k - std::min(k, FirstSampleOf(face))));
  }
}

void SurfaceSamples::FillOutlineBlock(size_t block, std::vector<Vector3>* points) const {
  if (block < vertex_blocks()) return FillVertexBlock(block, points);
  FillEdgeBlock(block - vertex_blocks(), points);
}

void SurfaceSamples::FillVertexBlock(size_t block, std::vector<Vector3>* points) const {
  points->clear();
  const size_t begin = block * kBlock;
  const size_t end = std::min<size_t>(begin + kBlock, vertices_.size());
  for (size_t i = begin; i < end; ++i) points->push_back(mesh_.positions[vertices_[i]]);
}

void SurfaceSamples::FillEdgeBlock(size_t block, std::vector<Vector3>* points) const {
  points->clear();
  const size_t begin = block * kBlock;
  const size_t end = std::min<size_t>(begin + kBlock, edges_.size());
  for (size_t e = begin; e < end; ++e) {
    const Edge& edge = edges_[e];
    const Vector3& a = mesh_.positions[edge.a];
    const Vector3 along = Difference(mesh_.positions[edge.b], a);
    // Rounded at random, so that short edges have their share.
    const auto inner = static_cast<uint64_t>(EdgeLength(edge) * samples_per_length_ + Hashed(e));
    for (uint64_t i = 1; i <= inner; ++i) {
      const double s = static_cast<double>(i) / static_cast<double>(inner + 1);
      points->push_back(Combination(a, s, along, 0, along));
    }
  }
}

}  // namespace folprom::measure
