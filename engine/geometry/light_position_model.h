// Where a split puts its new vertex, by few quantities and tables: what a LatticeCoder predicts
// with at the fastest effort.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "engine/entropy/cell_model.h"
#include "engine/entropy/online_regression.h"
#include "engine/geometry/light_cell_model.h"
#include "engine/geometry/light_ring.h"
#include "engine/geometry/light_spokes.h"
#include "engine/mesh/coordinate_planes.h"
#include "engine/mesh/types.h"

namespace folprom {

class LightPositionModel {
 public:
  /// Coordinates lie in [lo, hi].
  LightPositionModel(const std::array<int32_t, 3>& lo, const std::array<int32_t, 3>& hi);
  void UsePlanes(std::shared_ptr<const CoordinatePlanes> planes) { planes_ = std::move(planes); }

  /// Codes the cells, of 2^shifts lattice units by axis, of the vertex that a split of `old` adds;
  /// truth: its own, encoder only. The meters take the cost along and across the surface.
  template <class Coder>
  std::array<int32_t, 3> Code(Coder& coder, const Int3& old, const LightRing& ring,
                              const std::array<uint8_t, 3>& shifts,
                              const std::array<int32_t, 3>& truth, uint64_t* tangential_meter,
                              uint64_t* normal_meter);

 private:
  struct Vertex;
  struct Meters {
    uint64_t *tangential, *normal;
  };
  /// Of a vertex that is on no spoke.
  template <class Coder>
  void CodeCells(Coder& coder, const std::array<int32_t, 3>& truth, Meters meters, Vertex* vertex);
  template <class Coder>
  void CodeAlong(Coder& coder, uint32_t step, int32_t truth, Vertex* vertex);
  template <class Coder>
  void CodeAcross(Coder& coder, int32_t truth, Vertex* vertex);
  /// A coordinate whose density is given in cells.
  template <class Coder>
  int32_t CodeCell(Coder& coder, uint32_t step, double mean, double scale, uint32_t side_context,
                   int32_t truth, Vertex* vertex);
  /// Kept within bounds.
  static double InSpacings(double length, const Vertex& vertex);
  /// Is a vertex that may be on a spoke cheaper to tell so.
  bool PaysOnSpoke(const Vertex& vertex, const std::array<int32_t, 3>& truth);

  std::array<int32_t, 3> lo_, hi_;
  std::vector<OnlineRegression<2>> fit_;  ///< by number of neighbours, in spacings
  ScaleTable along_scale_, across_scale_;
  LightSpokes spokes_;
  uint32_t trials_ = 0;  ///< of the first, encoder only
  /// By step: without planes near, beside them, and on one, which.
  std::array<LightCellModel, 3> cells_, beside_planes_, planes_cells_;
  std::shared_ptr<const CoordinatePlanes> planes_;
  std::vector<PlainState> on_plane_;
};

}  // namespace folprom
