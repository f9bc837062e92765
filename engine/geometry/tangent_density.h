// Where beside a vertex its split is likely to put the new one, over the tangent plane.
//
// A log-linear model over the cells of a grid around the expected place: what the distances to the
// old vertex and to each neighbour say adds up. The weights learn from each new vertex.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/entropy/axis_density.h"
#include "engine/entropy/lanes.h"
#include "engine/entropy/learned_state.h"
#include "engine/geometry/ring_shape.h"

namespace folprom {

class TangentDensity {
 public:
  /// step: between cells of the grid, in twentieths of the spacing, 1 .. 4. The weights are those
  /// of a grid of step 2 for all, so that what is learnt with one step serves the others.
  explicit TangentDensity(uint32_t step);

  /// Before a vertex: weighs the cells. ahead: where the new vertex is expected, relative to the
  /// old.
  void Prepare(const RingShape& ring, const Vector3& ahead);
  /// Density of the offset along an axis of the lattice, lattice units.
  void First(uint32_t axis, AxisDensity* density) const;
  /// The same for a second axis, the offset along the first being known.
  void Second(uint32_t axis, uint32_t first, double first_offset, AxisDensity* density);
  /// After a vertex: its offset along the second axis.
  void Learn(double second_offset);
  void Visit(LearnedStateVisitor& visitor);

 private:
  /// Of the grid of step 2.
  static constexpr uint32_t kAlong = 15, kAside = 11;
  static constexpr uint32_t kFolded = kAlong * (kAside / 2 + 1);
  static constexpr uint32_t kMostGroups = ((2 * kAlong - 1) * (2 * kAside - 1) + 3) / kLanes;
  static constexpr uint32_t kMostCells = kMostGroups * kLanes;
  static constexpr uint32_t kEccentricities = 6, kCounts = 4;
  static constexpr uint32_t kFarBuckets = 28;   ///< of the distance to the old vertex
  static constexpr uint32_t kNearBuckets = 28;  ///< of the distance to a neighbour
  static constexpr uint32_t kRingBuckets = 6;   ///< of that neighbour's distance to the old vertex
  static constexpr uint32_t kMostNeighbours = 12;
  using PairTable = std::array<std::array<float, kNearBuckets>, kRingBuckets>;
  /// A cell that the offset along the first axis leaves possible.
  struct Possible {
    uint32_t cell;
    float mean, mass;
  };
  /// Of the pair table, by neighbour.
  using PairRows = std::array<float*, kMostNeighbours>;
  PairRows RowsOfNeighbours();
  void Weigh(const std::array<std::array<float, 2>, kMostNeighbours>& neighbours);
  /// Groups of less weight do not count.
  void LeaveOutUnlikely(float least);
  std::span<const uint16_t> Likely() const { return std::span(likely_).first(likely_count_); }
  Lanes CentreOn(uint32_t axis, uint32_t group) const;
  double WidthOn(uint32_t axis) const;

  double reach_;                   ///< how far a cell reaches along the surface, in spacings
  uint32_t cells_ = 0;             ///< of the grid
  uint32_t groups_ = 0;            ///< of four cells; the last is filled up with cells of no weight
  float half_along_, half_aside_;  ///< of the grid, in spacings
  // Offset of each cell from the expected place in spacings, and where its weight is.
  Lanes along_[kMostGroups], aside_[kMostGroups];
  std::array<uint16_t, kMostCells> place_of_;
  std::vector<std::array<float, kFolded>> place_;  ///< log weights, per context
  std::vector<std::array<float, kFarBuckets>> far_;
  std::vector<PairTable> pair_;

  // The vertex under way.
  double spacing_ = 1;
  Vector3 normal_{0, 0, 1}, along_axis_{1, 0, 0}, aside_axis_{0, 1, 0};
  float eccentricity_ = 0;
  Lanes weight_[kMostGroups];
  std::array<uint16_t, kMostGroups> likely_;  ///< groups that count, the first so many
  uint32_t likely_count_ = 0;
  float total_ = 1;  ///< of their weights
  LaneIntegers far_bucket_[kMostGroups], near_bucket_[kMostNeighbours][kMostGroups];
  std::array<uint8_t, kMostNeighbours> ring_bucket_;
  uint32_t neighbours_ = 0, context_ = 0, count_context_ = 0;
  double second_width_ = 1;
  std::array<Possible, kMostCells> possible_;
  uint32_t possible_count_ = 0;
};

}  // namespace folprom
