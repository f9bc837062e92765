// Positions on the integer lattice: a new vertex beside an old one, and further bits of known ones.
//
// What is known of a coordinate are its upper bits: a cell of 2^shift lattice steps. So positions
// end exact, and precision arrives when the level of detail can use it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/entropy/cell_model.h"
#include "engine/entropy/mixed_model.h"
#include "engine/entropy/online_regression.h"
#include "engine/geometry/ring_shape.h"
#include "engine/geometry/tangent_density.h"
#include "engine/mesh/types.h"

namespace folprom {

/// Shifts of the cells at this stage: across the surface's normal, and along it.
struct LatticePrecision {
  uint32_t tangential = 0;
  uint32_t normal = 0;
};

/// How much work goes into predicting.
struct LatticeSettings {
  uint32_t density_step;  ///< of the TangentDensity; 0: none
  uint32_t mixers;        ///< of the MixedModel of cells
};

class LatticeCoder {
 public:
  /// Coordinates lie in [lo, hi].
  LatticeCoder(const Int3& lo, const Int3& hi, LatticeSettings settings);

  /// A vertex that is known exactly. It gets the next number.
  void AddExact() { shifts_.push_back({0, 0, 0}); }

  /// Codes the vertex that a split of `old` adds and returns what is known of its position. It gets
  /// the next number. truth: encoder only. The meters take the cost along and across the surface.
  template <class Coder>
  Int3 CodeNew(Coder& coder, const Int3& old, const RingShape& ring, LatticePrecision precision,
               const Int3& truth, uint64_t* tangential_meter, uint64_t* normal_meter);

  /// Does the vertex know less than the precision asks for, whatever its normal.
  bool IsCoarser(uint32_t vertex, LatticePrecision precision) const;
  /// Codes the bits of a vertex that are missing at this precision; returns its position.
  template <class Coder>
  Int3 Refine(Coder& coder, uint32_t vertex, const Int3& known, const RingShape& ring,
              LatticePrecision precision, const Int3& truth);
  void Visit(LearnedStateVisitor& visitor);

 private:
  using Shifts = std::array<uint8_t, 3>;
  int32_t Centre(uint32_t axis, int32_t cell, uint32_t shift) const;

  std::array<int32_t, 3> lo_, hi_;
  bool has_density_;
  std::vector<Shifts> shifts_;
  CellModel<3, 2, 1> tangential_;
  TangentDensity density_;
  AxisDensity axis_density_;
  CellModel<2, 2> normal_;
  /// Offset of the new vertex from the means of the ring, by number of neighbours.
  std::vector<OnlineRegression<5>> tangential_fit_;
  ScaleTable tangential_scale_;
  ScaleTable normal_scale_;
  MixedModel<2> refine_;
};

}  // namespace folprom
