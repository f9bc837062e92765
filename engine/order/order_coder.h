// The order section: vertices, then faces, in blocks; what both directions share.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "engine/order/face_walk.h"
#include "engine/order/order_mesh.h"
#include "engine/order/sweep.h"
#include "engine/order/vertex_walk.h"
#include "engine/order/work_space.h"

namespace folprom {

/// Vertices or faces whose bits are a block. The models run on from block to block.
inline constexpr uint32_t kOrderBlock = 65536;

/// Of a vertex at its place in the scan's order.
uint64_t OrderDigest(uint64_t place, const Int3& position);
/// Of a face there; of its vertices the places, of those of a soup the numbers.
uint64_t OrderDigest(uint64_t place, const Face& corners);

/// First all vertices, then all faces are coded, each block with a segment of the coder. Of a soup,
/// whose vertices stand where the faces name them, the faces alone.
class OrderCoder {
 public:
  /// sequence, place_of: as of VertexWalk; of a soup both are written by the faces.
  OrderCoder(const OrderMesh& mesh, std::span<uint32_t> sequence, std::span<uint32_t> place_of,
             bool is_soup, WorkSpace& space)
      : mesh_(mesh),
        sequence_(sequence),
        place_of_(place_of),
        is_soup_(is_soup),
        space_(space),
        vertices_done_(is_soup ? mesh.vertex_count() : 0) {}

  /// Vertices of the next block; 0: all are done.
  uint32_t NextVertices() const { return Next(vertices_done_, mesh_.vertex_count()); }
  template <class Coder>
  void CodeVertices(Coder& coder);

  /// Faces of the next block; 0: all are done.
  uint32_t NextFaces() const { return Next(faces_done_, mesh_.face_count()); }
  /// faces: as of FaceWalk, as many as NextFaces.
  template <class Coder>
  void CodeFaces(Coder& coder, std::span<Face> faces);

  /// Of all that was coded so far.
  uint64_t digest() const { return digest_; }

 private:
  static uint32_t Next(uint32_t done, uint32_t all) { return std::min(all - done, kOrderBlock); }
  void DigestVertices(uint32_t begin, uint32_t end);
  void DigestFaces(std::span<const Face> faces);

  const OrderMesh& mesh_;
  std::span<uint32_t> sequence_, place_of_;
  const bool is_soup_;
  WorkSpace& space_;
  uint32_t vertices_done_, faces_done_ = 0;
  std::optional<VertexWalk> vertices_;
  std::optional<FaceWalk> faces_;
  uint64_t digest_ = 0;
};

}  // namespace folprom
