// Points of a surface, by number: the same for every order in which they are asked for.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/measure/triangle_mesh.h"

namespace folprom::measure {

/// Points spread evenly over the area of a mesh, and points of its outline: vertices and points of
/// edges. Of a mesh without area, the vertices stand for the area. Keeps a reference to the mesh.
class SurfaceSamples {
 public:
  /// `count`: points on the area, at least 1.
  SurfaceSamples(const TriangleMesh& mesh, uint64_t count);

  /// The number of points; vertices instead where the mesh has no area.
  uint64_t area_count() const { return has_area() ? count_ : vertices_.size(); }
  size_t area_blocks() const;
  /// Replaces *points. Neighbours in the list lie near each other.
  void FillAreaBlock(size_t block, std::vector<Vector3>* points) const;

  size_t outline_blocks() const { return vertex_blocks() + edge_blocks(); }
  void FillOutlineBlock(size_t block, std::vector<Vector3>* points) const;

 private:
  struct Edge {
    uint32_t a, b;
  };
  bool has_area() const { return !area_before_.empty(); }
  size_t vertex_blocks() const;
  size_t edge_blocks() const;
  void CollectVertices();
  void CollectEdges();
  void SumAreas();
  double EdgeLength(const Edge& edge) const;
  uint64_t FirstSampleOf(size_t face) const;
  Vector3 PointOfFace(size_t face, uint64_t index) const;
  void FillVertexBlock(size_t block, std::vector<Vector3>* points) const;
  void FillEdgeBlock(size_t block, std::vector<Vector3>* points) const;

  const TriangleMesh& mesh_;
  const uint64_t count_;
  std::vector<double> area_before_;  ///< summed area of the faces before; empty without area
  std::vector<uint32_t> vertices_;   ///< of the surface
  std::vector<Edge> edges_;
  double samples_per_length_ = 0;
};

}  // namespace folprom::measure
