// Learns how one attribute follows from its neighbours and from the attributes before it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/attributes/value_model.h"
#include "engine/entropy/cell_model.h"
#include "engine/entropy/online_regression.h"

namespace folprom {

/// What the neighbours of a new vertex say of an attribute, as real values.
struct RingValues {
  double mean = 0;     ///< by inverse distance
  double even = 0;     ///< mean of all alike
  double nearest = 0;  ///< of the nearest neighbour
  double parent = 0;
  double spread = 0;   ///< mean distance from the mean
  double surface = 0;  ///< what the surface there says of it; the mean where it says nothing
};

/// What else the values of a vertex say of an attribute.
struct VertexValues {
  /// Misses of the two attributes before it, the last first. A miss is a value less the mean of the
  /// neighbours, in a unit of the attribute's own.
  std::array<double, 2> misses{};
  /// Its size, where it completes a vector of length 1; its sign is likely that of the neighbours.
  std::optional<double> rest;
};

class AttributeModel {
 public:
  explicit AttributeModel(const ValueSpan& span);

  /// Returns the ordered value and sets *miss.
  template <class Coder>
  uint64_t Code(Coder& coder, const RingValues& ring, const VertexValues& before, uint64_t value,
                double* miss);

 private:
  static constexpr size_t kFeatures = 6;

  ValueSpan span_;
  LearnedScale unit_;  ///< mean size of misses, those of outliers cut
  OnlineRegression<kFeatures> regression_;
  ScaleTable scales_, plain_scales_;
  std::vector<LearnedScale> rest_scales_;     ///< real values, by the octave of the rest
  double rest_wrong_ = 1, mean_wrong_ = 0.5;  ///< how far either misses, in units, of late
  ValueModel<3, 2> values_;
};

}  // namespace folprom
