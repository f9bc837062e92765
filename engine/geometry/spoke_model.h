// New vertices that lie a half, a third or a quarter of the way to a neighbour of the old one: in
// meshes that were subdivided, swept or laid out in rows many do.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/entropy/cell_model.h"
#include "engine/entropy/lanes.h"
#include "engine/entropy/learned_state.h"
#include "engine/geometry/ring_shape.h"
#include "engine/mesh/types.h"

namespace folprom {

/// Goes with a new vertex from decision to decision about its coordinates: a Bayesian mixture of
/// what other models say and of a narrow kernel around each such place.
class SpokeModel {
 public:
  SpokeModel();

  /// Next vertex, to be split from the one that the ring is around.
  void Start(const RingShape& ring);
  /// Its next coordinate, of one of cells [a, c) of 2^shift lattice units; old: that of the vertex
  /// it is split from. The first two go along the surface, the third across it.
  void Begin(uint32_t axis, uint32_t shift, int64_t a, int64_t c, int32_t old);
  /// The coordinate is coded.
  void End();

  /// A decision: is the cell at or above `at`. Others hold that to be likely by so many in 65536;
  /// so does the result, inside 1 .. 65535.
  uint32_t Weigh(int64_t at, uint32_t probability);
  /// How it came out.
  void Learn(bool above);

  void Visit(LearnedStateVisitor& visitor);

 private:
  static constexpr uint32_t kMostNeighbours = 12, kFractions = 3, kLengths = 6;
  static constexpr uint32_t kMostPlaces = kMostNeighbours * kFractions;
  static constexpr uint32_t kMostGroups = kMostPlaces / kLanes;
  /// Of the kernels of a group of places: what lies below a cell, less what lies above it.
  Lanes BelowLessAbove(uint32_t group, int64_t cell) const;
  void ExpectStraight();
  void Settle();
  void LearnPlaces();
  void LearnStraight();

  ScaleTable likely_;               ///< kinds of places
  std::array<float, 2> on_spokes_;  ///< vertices elsewhere and on spokes; older ones fade
  std::array<float, 2> straight_;   ///< of those on spokes: off them across the surface, and not

  // The vertex under way.
  uint32_t started_ = 0, step_ = 0, axis_ = 0, shift_ = 0, groups_ = 0, skipped_ = 0;
  int64_t old_ = 0;
  double other_weight_ = 1;  ///< of what the others say
  double other_ = 1;         ///< their probability of the decision
  double on_spoke_ = 0;      ///< how likely that was after two coordinates
  std::array<uint8_t, kMostPlaces> kind_;
  Lanes at_[3][kMostGroups];  ///< relative to the old vertex, lattice units
  Lanes weight_[kMostGroups];
  Lanes first_[kMostGroups], here_[kMostGroups], last_[kMostGroups];
};

}  // namespace folprom
