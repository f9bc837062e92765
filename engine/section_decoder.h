// Puts a decoded mesh as the scan had it, by the sections behind the last layer.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/entropy/bit_coder.h"
#include "engine/order/face_value_digest.h"
#include "engine/order/face_values.h"
#include "engine/order/order_coder.h"
#include "engine/order/polygon_digest.h"
#include "engine/order/polygon_joins.h"
#include "engine/order/polygon_set.h"
#include "io/container/block_code.h"
#include "io/container/reader.h"

namespace folprom {

/// Are all the sections of the file there, and are there any.
bool HasWholeSections(const io::ContainerReader& container);

/// Some faces of the scan, in its order.
struct FaceChunk {
  /// Places of their vertices; of a soup the numbers.
  std::vector<Face> triangles;
  /// 1 for a triangle that goes on with the polygon of the triangle before, maybe of the chunk
  /// before: (a, b, c), (a, c, d) ...; else 0. Empty in a file of triangles.
  std::vector<uint8_t> joins;
  std::vector<uint8_t> rows;  ///< see io::FaceSchema; empty where faces have no attributes
};

class SectionDecoder {
 public:
  /// positions and faces: of the whole mesh, its vertices numbered by CurvePlaces subtree by
  /// subtree, faces in any order. Decodes the order of the vertices. Throws Failure kCorrupt.
  SectionDecoder(const io::ContainerReader& container, std::span<const Int3> positions,
                 std::span<const Face> faces, WorkSpace& space);

  /// [i]: number of the vertex that stands at place i of the scan; i where its order is not kept.
  /// Of a soup it means nothing.
  std::span<const uint32_t> sequence() const { return sequence_; }
  /// The next faces; false, and nothing, where all were given and were those that the encoder had.
  /// Throws Failure kCorrupt.
  bool Next(FaceChunk* chunk);

 private:
  template <class Work>
  auto InSection(io::SectionKind kind, Work work);
  void ReadOrder(FaceChunk* chunk);
  void ReadSet(FaceChunk* chunk);
  void ReadNumbers(FaceChunk* chunk);
  /// Of the chunk's triangles, which are of the numbers of the mesh here.
  void ReadValues(FaceChunk* chunk);
  void CheckEnd();

  const io::ContainerReader& container_;
  OrderMesh mesh_;
  std::span<uint32_t> sequence_, place_of_;
  OrderCoder order_;
  io::BlockReader order_blocks_, polygon_blocks_, value_blocks_;
  BitDecoder order_bits_, polygon_bits_, value_bits_;
  PolygonJoins joins_;
  std::optional<PolygonSet> set_;  ///< where the order is not kept
  uint32_t numbers_done_ = 0;      ///< where neither order nor polygons are kept
  std::optional<FaceValueCoder> values_;
  PolygonDigest digest_;
  FaceValueDigest value_digest_;
};

}  // namespace folprom
