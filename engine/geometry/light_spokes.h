// New vertices in the middle of the way to a neighbour of the old one, told by a flag and the
// neighbour: a SpokeModel for the LightPositionModel.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/entropy/plain_decision.h"
#include "engine/geometry/light_ring.h"
#include "engine/mesh/types.h"

namespace folprom {

class LightSpokes {
 public:
  LightSpokes();

  /// A vertex whose coordinates are coded as cells of 2^shifts lattice units, in the
  /// order of the ring's axes.
  struct Vertex {
    const Int3& old;
    const LightRing& ring;
    std::array<uint8_t, 3> shifts;  ///< by axis, as all cells
    Vector3 expected;               ///< place, relative to the old vertex
    std::array<int32_t, 3> lo, hi;  ///< cells
  };

  /// Next vertex: is it asked whether it is on a spoke. Where few are, one in eight is.
  bool Asks(uint32_t neighbours);
  PlainState* flag() { return &flag_; }
  /// How it came out.
  void Learn(bool on_spoke);

  /// Is there a middle with which the first two cells agree.
  bool Finds(const Vertex& vertex, const std::array<int32_t, 3>& cells) const;
  /// Codes the cells along the surface of a vertex that is on a spoke, and, where the spoke holds
  /// across it, the third. Returns whether it does.
  template <class Coder>
  bool Code(Coder& coder, const Vertex& vertex, const std::array<int32_t, 3>& truth,
            std::array<int32_t, 3>* cells);

 private:
  static constexpr uint32_t kMostNeighbours = 12, kRanks = 12, kParts = 4;
  struct Middle {
    uint32_t neighbour;
    double distance2;  ///< from the expected place
  };
  static double PlaceOn(const Vertex& vertex, uint32_t neighbour, uint32_t axis);
  static bool IsAt(const Vertex& vertex, uint32_t neighbour, const std::array<int32_t, 3>& cells);
  template <class Coder>
  int64_t CodeBeside(Coder& coder, uint32_t step, double place, int32_t truth);

  PlainState flag_ = kEvenState, straight_ = kEvenState;
  std::array<PlainState, kRanks> later_;  ///< by rank: a middle further from the expected place
  /// By step and quarter of the cell that the middle is in.
  std::array<std::array<PlainState, kParts>, 3> beside_, above_;
  uint32_t share_;  ///< of vertices on spokes, 1/65536
  uint32_t skipped_ = 0;
};

}  // namespace folprom
