// The mesh that half-edge contraction shrinks: which vertices are left, what surrounds them, what a
// contraction would cost and whether it may be.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/connectivity/block_lists.h"
#include "engine/hierarchy/quadric.h"
#include "engine/mesh/types.h"
#include "engine/partition/partition.h"

namespace folprom {

class ContractionMesh {
 public:
  /// Faces into other subtrees take part with points that stay where they are.
  ContractionMesh(std::span<const Int3> positions, std::span<const Face> faces,
                  std::span<const CrossFace> cross_faces, uint32_t subtree);

  uint32_t vertices() const { return own_; }
  bool IsLive(uint32_t v) const { return vertices_[v].merged_into == v; }
  /// A third of the area of the faces that were ever around it, and what open edges weigh.
  double AreaOf(uint32_t v) const {
    const double scale = static_cast<double>(scale_);
    return static_cast<double>(vertices_[v].quadric.weight) / (scale * scale);
  }
  double Distance(uint32_t a, uint32_t b) const;
  /// Is this an object of flat faces that meet in edges, as machines and buildings are?
  bool HasFacesAndEdges() const;

  /// Asks for the memory of a vertex and of where its star is, once that is there of its star, then
  /// of its faces, and then of their corners.
  void PrefetchVertex(uint32_t v) const {
    __builtin_prefetch(&vertices_[v]);
    stars_.PrefetchList(v);
  }
  void PrefetchStar(uint32_t v) const { stars_.Prefetch(v); }
  void PrefetchFaces(uint32_t v) const;
  void PrefetchCorners(uint32_t v) const;

  /// The distinct neighbours of v, until the next call.
  std::span<const uint32_t> CollectRing(uint32_t v);
  /// Quadric error, and length_weight x area x length^2; more where a vertex would leave the border
  /// to another subtree.
  float CostOf(uint32_t v, uint32_t target, float length_weight) const;
  /// Would no face turn over, and the surface not be pinched. Of the v whose ring was collected.
  bool IsAllowed(uint32_t v, uint32_t target);
  /// Would two places where the subtree's surface ends meet at a point. Of the same v.
  bool PinchesRims(uint32_t v, uint32_t target);
  /// v goes; returns the distance of target from v's planes, lattice units.
  double Contract(uint32_t v, uint32_t target);
  /// Faces around v, collapsed ones too.
  uint32_t StarSize(uint32_t v) const { return stars_.SizeOf(v); }

 private:
  /// What a contraction reads of each neighbour lies in one cache line.
  struct alignas(64) Vertex {
    Int3 position;
    uint32_t merged_into;
    uint32_t stamp = 0;
    Quadric quadric;
  };
  /// Where a subtree's surface ends: at faces into others, at edges of one face.
  enum Rim : uint8_t { kBorder = 1, kOpenEdge = 2 };
  enum class Bend { kFlat, kSmooth, kSharp };
  using Offset = Quadric::Offset;

  uint32_t AddPoint(const Int3& p);
  void ChooseScale(std::span<const Int3> positions);
  uint32_t Find(uint32_t v);
  Offset From(uint32_t a, uint32_t b) const;
  Vector3 AreaNormal(uint32_t a, uint32_t b, uint32_t c) const;
  void LinkStars();
  void AddFacePlanes();
  void AddBoundaryPlanes();
  void AddBoundaryPlane(uint32_t a, uint32_t b, const Face& face);
  Bend BendAt(uint32_t v) const;
  void AddToRing(uint32_t w);
  std::span<const uint32_t> Ring() const { return std::span(ring_).first(ring_size_); }
  bool IsOwn(const Face& face) const { return face[0] < own_ && face[1] < own_ && face[2] < own_; }
  bool LeavesBorder(uint32_t v, uint32_t target) const {
    return (rims_[v] & kBorder) != 0 && (rims_[target] & kBorder) == 0;
  }
  /// Do fewer faces of the subtree than neighbours lie around v.
  bool IsOpen(uint32_t v);
  uint32_t CommonNeighbours(uint32_t target);
  bool AreNeighbours(uint32_t v, uint32_t other);

  uint32_t own_;
  float scale_ = 1;               ///< of lengths in quadrics and costs; a power of two
  std::vector<Vertex> vertices_;  ///< own vertices, then a point per foreign corner
  std::vector<Face> faces_;
  BlockLists<uint32_t> stars_;
  std::vector<uint8_t> rims_;  ///< per own vertex: the Rims at which it is, or what it took in
  std::vector<uint32_t> ring_, collapsed_;  ///< ring_ has room for more than ring_size_
  uint32_t ring_size_ = 0;
  uint32_t stamp_ = 0;
};

}  // namespace folprom
