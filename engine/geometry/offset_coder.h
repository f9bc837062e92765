// Codes how many children a vertex set has and where they lie (sections 2.2, 2.3), and the halving
// of cells (section 2.4).
#pragma once

#include <cstdint>
#include <vector>

#include "engine/entropy/integer_model.h"
#include "engine/entropy/mixed_model.h"
#include "engine/entropy/value_tally.h"
#include "engine/geometry/cylinder_cell.h"
#include "engine/geometry/local_frame.h"

namespace folprom {

/// Which of the paper's techniques are on, and its constants.
struct OffsetSettings {
  uint32_t children = 4;
  uint32_t levels = 32;
  bool adaptive = true;
  bool predict_theta = true;
  bool predict_height = true;
  bool cartesian = false;  ///< x, y instead of rho, theta
};

/// Offset of one child in steps of its dimension. Cartesian: theta and rho hold x and y plus 2^31,
/// so that they sort as x and y do.
struct OffsetIndex {
  uint32_t theta = 0;  ///< below Q
  uint32_t rho = 0;
  int32_t z = 0;
};

/// Steps of one split: G_rho, G_theta, G_z of section 2.2. Cartesian: rho is that of x and y.
struct OffsetSteps {
  double rho = 1, theta = 1, z = 1;
};

/// The numbers that are coded for offsets: what is left after prediction. Cartesian: theta is x and
/// rho is y, here and in the costs.
struct OffsetTally {
  ValueTally theta, rho, z;
};

/// Costs of offsets in 1/1024 bit.
struct OffsetMeters {
  uint64_t theta = 0, rho = 0, z = 0;
  OffsetTally* tally = nullptr;  ///< encoder only; not null: takes the numbers

  uint64_t Sum() const { return theta + rho + z; }
};

/// Learning state of the geometry decisions, kept from layer to layer.
class OffsetCoder {
 public:
  explicit OffsetCoder(const OffsetSettings& settings);

  /// Steps from the neighbours' ranges, not below `least` lattice units.
  OffsetSteps StepsFor(const Neighbourhood& at, double least) const;
  OffsetIndex Quantise(const Neighbourhood& at, const OffsetSteps& steps, const Int3& point) const;
  CylinderCell CellOf(const Neighbourhood& at, const OffsetSteps& steps,
                      const OffsetIndex& index) const;

  /// What both sides know about a set before it is split.
  struct SetContext {
    double spacing = 0;  ///< mean distance to the neighbours, lattice units
    uint32_t leaf_neighbours = 0;
    uint32_t other_neighbours = 0;
  };
  /// Number of children of a set that is no single vertex, 2 .. K.
  template <class Coder>
  uint32_t CodeChildCount(Coder& coder, const SetContext& context, uint32_t count);

  /// Offsets in the lexicographic order of (theta, rho, z); resized to `count`. `meters` receive
  /// the costs.
  template <class Coder>
  void CodeOffsets(Coder& coder, const Neighbourhood& at, const OffsetSteps& steps, uint32_t count,
                   std::vector<OffsetIndex>* offsets, OffsetMeters* meters);

  /// Which half of the cell holds the vertex.
  template <class Coder>
  bool CodeHalf(Coder& coder, const CylinderCell& cell, CylinderCell::Dimension dimension,
                bool upper);

 private:
  /// What both sides know while the children of one set are coded.
  struct Siblings {
    const Neighbourhood& at;
    const OffsetSteps& steps;
    uint32_t count, steep, hollow;
    uint32_t rho_before = 0, z_before = 0;
  };
  /// theta of child `i`: offsets before it are known.
  template <class Coder>
  uint32_t CodeTheta(Coder& coder, const Siblings& siblings, uint32_t i,
                     const std::vector<OffsetIndex>& offsets, OffsetMeters* meters);
  template <class Coder>
  uint32_t CodeRho(Coder& coder, const Siblings& siblings, uint32_t i, double expected,
                   uint32_t index, OffsetMeters* meters);
  /// x and y of child `i`.
  template <class Coder>
  OffsetIndex CodePlane(Coder& coder, const Siblings& siblings, uint32_t i,
                        const std::vector<OffsetIndex>& offsets, OffsetMeters* meters);
  /// Height of child `i`, `rho` lattice units from the axis, where the surface has `bend`.
  template <class Coder>
  int32_t CodeHeight(Coder& coder, Siblings& siblings, uint32_t i, double rho, double bend,
                     int32_t index, OffsetMeters* meters);

  OffsetSettings settings_;
  MixedModel<2> is_full_;
  MixedModel<1> fewer_;
  IntegerModel<2> first_theta_;
  IntegerModel<2> theta_;
  IntegerModel<2> rho_;
  IntegerModel<2> x_;
  IntegerModel<2> y_;
  IntegerModel<2> z_;
  MixedModel<1> half_;
};

}  // namespace folprom
