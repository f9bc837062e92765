// Positions on the integer lattice: a new vertex beside an old one, and further bits of known ones.
//
// What is known of a coordinate are its upper bits: a cell of 2^shift lattice steps. So positions
// end exact, and precision arrives when the level of detail can use it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "engine/entropy/cell_model.h"
#include "engine/entropy/mixed_model.h"
#include "engine/entropy/online_regression.h"
#include "engine/geometry/light_ring.h"
#include "engine/geometry/plane_model.h"
#include "engine/geometry/ring_shape.h"
#include "engine/geometry/spoke_model.h"
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
  bool light = false;     ///< new vertices by the LightPositionModel
};

class LightPositionModel;

class LatticeCoder {
 public:
  /// Coordinates lie in [lo, hi].
  LatticeCoder(const Int3& lo, const Int3& hi, LatticeSettings settings);
  ~LatticeCoder();

  /// From now on coordinates on these planes are likelier.
  void UsePlanes(std::shared_ptr<const CoordinatePlanes> planes);

  /// A vertex that is known exactly. It gets the next number.
  void AddExact() { shifts_.push_back({0, 0, 0}); }

  /// Codes the vertex that a split of `old` adds and returns what is known of its position. It gets
  /// the next number. truth: encoder only. The meters take the cost along and across the surface.
  template <class Coder>
  Int3 CodeNew(Coder& coder, const Int3& old, const RingShape& ring, LatticePrecision precision,
               const Int3& truth, uint64_t* tangential_meter, uint64_t* normal_meter);
  /// The same with light models.
  template <class Coder>
  Int3 CodeNew(Coder& coder, const Int3& old, const LightRing& ring, LatticePrecision precision,
               const Int3& truth, uint64_t* tangential_meter, uint64_t* normal_meter);

  /// Does the vertex know less than the precision asks for, whatever its normal.
  bool IsCoarser(uint32_t vertex, LatticePrecision precision) const {
    const uint32_t least = std::min(precision.tangential, precision.normal);
    const Shifts& shifts = shifts_[vertex];
    return shifts[0] > least || shifts[1] > least || shifts[2] > least;
  }
  /// Codes the bits of a vertex that are missing at this precision; returns its position.
  template <class Coder>
  Int3 Refine(Coder& coder, uint32_t vertex, const Int3& known, const RingPlane& ring,
              LatticePrecision precision, const Int3& truth);
  void Visit(LearnedStateVisitor& visitor);

 private:
  using Shifts = std::array<uint8_t, 3>;
  struct NewVertex;
  struct Coordinate;
  /// The cell of a coordinate, by one of the two models.
  template <size_t N, class Coder, class Model>
  int32_t CodeCell(Coder& coder, const NewVertex& vertex, const Coordinate& at,
                   const std::array<uint32_t, N>& contexts,
                   const std::array<CellPrediction, 2>& predictions, const AxisDensity* measured,
                   Model* model, CellModel<N + 1, 2, 1>* on_planes);
  template <class Coder>
  int32_t CodeAlong(Coder& coder, const Coordinate& at, NewVertex* vertex);
  template <class Coder>
  int32_t CodeAcross(Coder& coder, const Coordinate& at, const NewVertex& vertex);
  /// One more bit of a coordinate.
  template <class Coder>
  bool CodeHalf(Coder& coder, uint32_t axis, uint32_t lean_context, const Int3& known,
                const Shifts& shifts, bool upper);
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
  // The same where coordinates on planes are likelier.
  SpokeModel spokes_;
  PlaneModel plane_model_;
  CellModel<4, 2, 1> tangential_on_planes_;
  CellModel<3, 2, 1> normal_on_planes_;
  MixedModel<4> refine_on_planes_;
  std::unique_ptr<LightPositionModel> light_;  ///< instead of all others for new vertices
};

}  // namespace folprom
