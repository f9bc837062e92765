// The order of vertices, as a walk through the mesh from each one to the next.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/order/choice_coder.h"
#include "engine/order/order_mesh.h"
#include "engine/order/sweep.h"

namespace folprom {

/// Codes which vertex comes next, over and over: one of the neighbours of those before, or any.
class VertexWalk {
 public:
  /// sequence[i]: the vertex that comes i-th; read by an encoder, written by a decoder. place_of:
  /// its inverse, written. Both have a number for each vertex.
  VertexWalk(const OrderMesh& mesh, const Sweep& sweep, std::span<uint32_t> sequence,
             std::span<uint32_t> place_of);

  /// Codes the next `count` vertices. Throws Failure kCorrupt.
  template <class Coder>
  void Code(Coder& coder, uint32_t count);

 private:
  static constexpr size_t kContexts = 5;
  /// What speaks for a vertex: it is a neighbour of ...
  enum Reason : uint32_t {
    kOfLast = 1,        ///< the vertex before
    kOfSecond = 2,      ///< the one before that
    kOfThird = 4,       ///< and before that
    kOfRow = 8,         ///< the neighbour of the last that came first
    kOfNextInRow = 16,  ///< the vertex that came after that
    kOfFront = 32,      ///< the first of all that has neighbours left
    kCoincident = 64,   ///< or it lies where one of the last three does
    kReasons = 128
  };
  struct Found {
    uint32_t vertex;
    uint32_t reasons;
    double distance;  ///< squared, to where the walk points
  };

  void Collect();
  void Add(uint32_t vertex, uint32_t reason);
  void AddNeighbours(uint32_t vertex, uint32_t reason);
  void AddCoincident(uint32_t vertex);
  /// The least place of a neighbour.
  uint32_t FirstNeighbour(uint32_t vertex) const;
  bool HasNeighboursLeft(uint32_t vertex) const;
  template <class Coder>
  uint32_t CodeNear(Coder& coder, uint32_t vertex);
  /// The vertex coded so many steps ago; kNoNumber before the first.
  uint32_t Before(uint32_t steps) const {
    return next_ < steps ? kNoNumber : sequence_[next_ - steps];
  }

  const OrderMesh& mesh_;
  std::span<uint32_t> sequence_, place_of_;
  Remaining remaining_;
  uint32_t next_ = 0, front_ = 0;
  std::vector<Found> found_;
  std::vector<Option<kContexts>> options_;
  uint32_t history_ = 0;       ///< of the last vertices: was it found near; a bit each
  uint32_t last_reasons_ = 0;  ///< of the vertex before; 0 where it was not near
  MixedModel<2> near_;
  ChoiceCoder<kContexts> choice_;
};

}  // namespace folprom
