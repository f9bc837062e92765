// Which triangles are one face of the scan, where their order is not known.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/entropy/integer_model.h"
#include "engine/entropy/mixed_model.h"
#include "engine/order/order_mesh.h"
#include "engine/order/unused_set.h"
#include "engine/order/work_space.h"

namespace folprom {

/// What an encoder knows: the triangles of the scan in its order, of the numbers of the mesh, and
/// which of them go on with the one before, as in PolygonJoins.
class PolygonTruth {
 public:
  PolygonTruth(const OrderMesh& mesh, std::span<const Face> faces, std::span<const uint8_t> joins,
               WorkSpace& space);

  /// Triangles first .. last of the scan: the polygon of the triangle that has this number.
  struct Fan {
    uint32_t first, last;
  };
  Fan FanOf(uint32_t number) const;
  const Face& face(uint32_t triangle) const { return faces_[triangle]; }
  uint32_t TriangleOf(uint32_t number) const { return triangle_of_[number]; }
  /// Gives the triangle the number of an equal one, and that one its own.
  void Assign(uint32_t triangle, uint32_t number);

 private:
  std::span<const Face> faces_;
  std::span<const uint8_t> joins_;
  std::span<uint32_t> number_of_, triangle_of_;
};

/// Codes polygon by polygon: from the first triangle of the mesh that is in none yet over those of
/// its edges that are no edges of the polygon. A polygon that this does not give back is written
/// out corner by corner.
class PolygonSet {
 public:
  /// truth: of an encoder, else null.
  PolygonSet(const OrderMesh& mesh, PolygonTruth* truth, WorkSpace& space);

  bool AtEnd() const { return left_.left() == 0; }
  /// Codes polygons until they have `most` triangles or more, and appends them as in FaceChunk;
  /// each begins with any of its corners. fans: of an encoder, what they are in the scan; may be
  /// null. Throws Failure kCorrupt.
  template <class Coder>
  void Code(Coder& coder, uint32_t most, std::vector<Face>* triangles, std::vector<uint8_t>* joins,
            std::vector<PolygonTruth::Fan>* fans = nullptr);

 private:
  /// Vertices that make triangles across an edge.
  void CollectMates(uint32_t from, uint32_t to);
  /// The first number that is left of this triangle; kNoNumber.
  uint32_t FirstLeft(const Face& face) const;
  /// Decide(edge): the vertex across it, kNoNumber for none.
  template <class Decide>
  void Grow(uint32_t number, Decide decide);
  bool PlanGrowth(uint32_t number);
  template <class Coder>
  uint32_t CodeMate(Coder& coder, size_t edge, uint32_t mate);
  template <class Coder>
  void CodeCorners(Coder& coder, const PolygonTruth::Fan& fan);
  void Take(const Face& face, uint32_t number);
  void Settle(const PolygonTruth::Fan& fan, bool is_listed);
  uint32_t LengthRank(size_t edge) const;
  uint32_t Direction(size_t edge) const;

  const OrderMesh& mesh_;
  PolygonTruth* truth_;
  WorkSpace& space_;
  UnusedSet left_;
  std::vector<uint32_t> corners_;  ///< of the polygon so far, a cycle
  std::vector<Face> members_;      ///< its triangles
  std::vector<uint32_t> numbers_;  ///< of these
  std::vector<uint32_t> mates_;
  std::vector<uint32_t> plan_;  ///< decisions of an encoder
  uint32_t last_size_ = 3, size_before_ = 3;
  MixedModel<1> is_listed_;
  MixedModel<3> is_joined_;
  MixedModel<1> is_mate_;
  IntegerModel<1> sizes_;
};

}  // namespace folprom
