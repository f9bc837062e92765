// Where beside a vertex its split is likely to put the new one, over the tangent plane.
//
// A log-linear model over the cells of a grid around the expected place: what the distances to the
// old vertex and to each neighbour say adds up. The weights learn from each new vertex.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/entropy/axis_density.h"
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
  static constexpr size_t kAlong = 15, kAside = 11;
  static constexpr size_t kFolded = kAlong * (kAside / 2 + 1);
  static constexpr size_t kMostCells = (2 * kAlong - 1) * (2 * kAside - 1);
  /// A cell of the grid: its offset from the expected place in spacings, and where its weight is.
  struct Cell {
    double along, aside;
    uint16_t place;
  };
  static constexpr uint32_t kEccentricities = 6, kCounts = 4;
  static constexpr uint32_t kFarBuckets = 28;   ///< of the distance to the old vertex
  static constexpr uint32_t kNearBuckets = 28;  ///< of the distance to a neighbour
  static constexpr uint32_t kRingBuckets = 6;   ///< of that neighbour's distance to the old vertex
  static constexpr size_t kMostNeighbours = 12;
  using PairTable = std::array<std::array<float, kNearBuckets>, kRingBuckets>;
  double WidthOn(uint32_t axis) const;

  double reach_;  ///< how far a cell reaches along the surface, in spacings
  std::vector<Cell> cells_;
  std::vector<std::array<float, kFolded>> place_;  ///< log weights, per context
  std::vector<std::array<float, kFarBuckets>> far_;
  std::vector<PairTable> pair_;

  // The vertex under way.
  double spacing_ = 1;
  Vector3 normal_{0, 0, 1};
  std::array<Vector3, kMostCells> centre_;
  std::array<double, kMostCells> weight_, conditional_;
  std::array<uint8_t, kMostCells> far_bucket_;
  std::array<std::array<uint8_t, kMostNeighbours>, kMostCells> near_bucket_;
  std::array<uint8_t, kMostNeighbours> ring_bucket_;
  size_t neighbours_ = 0;
  uint32_t context_ = 0, count_context_ = 0;
  uint32_t second_axis_ = 0, first_axis_ = 0;
  double slope_ = 0, first_offset_ = 0, second_width_ = 1;
};

}  // namespace folprom
