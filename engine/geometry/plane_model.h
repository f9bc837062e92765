// How much likelier coordinates are that many vertices share.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "engine/entropy/cell_model.h"
#include "engine/entropy/learned_state.h"
#include "engine/entropy/plane_window.h"
#include "engine/mesh/coordinate_planes.h"

namespace folprom {

/// Goes with a new vertex from coordinate to coordinate; cells have 2^shift lattice units. Cells on
/// planes weigh more than a distribution says, by factors that learn.
class PlaneModel {
 public:
  PlaneModel();
  void Use(std::shared_ptr<const CoordinatePlanes> planes) { planes_ = std::move(planes); }

  /// A coordinate that is coded next.
  struct Coordinate {
    uint32_t axis, shift;
    int32_t lo, hi;  ///< cells that it may be in
    double near;     ///< cell that it is likely near
    int32_t old;     ///< cell of the vertex that the new one is split from
  };
  /// Next vertex.
  void Start() { step_ = 0, known_ = 0; }
  /// below(k): what of the coordinate's distribution lies below cell k. Returns false where the
  /// planes say nothing.
  template <class Below>
  bool Weigh(const Coordinate& coordinate, const Below& below, PlaneWindow* window);
  /// After Weigh: what is known of the vertex, below kContexts.
  static constexpr uint32_t kContexts = 81;
  uint32_t context() const { return context_; }
  /// How it came out.
  void Learn(int32_t cell);

  /// Which half of a coordinate's cell holds a plane.
  struct HalfSigns {
    bool tells = false;
    std::array<uint32_t, 2> contexts{};
  };
  static constexpr std::array<uint32_t, 2> kHalfContexts{2 * 16 * 3 * 3, 2 * 32};
  /// cells: of the vertex as it is known, of more than one lattice unit on this axis. Does not tell
  /// where both halves hold a plane, or none.
  HalfSigns SignsOf(uint32_t axis, const std::array<int32_t, 3>& cells,
                    const std::array<uint8_t, 3>& shifts) const;
  void Visit(LearnedStateVisitor& visitor) { visitor.Scales(weights_); }

 private:
  enum Place : uint32_t { kUnknown, kOff, kOn };
  static constexpr uint32_t kPlaces = 3, kSteps = 3;
  /// Is the cell on a plane; unknown where cells are too large to tell.
  Place PlaceOf(uint32_t axis, uint32_t shift, int32_t cell) const;
  /// Lattice units between the planes around a coordinate.
  int64_t GapAt(uint32_t axis, int64_t coordinate) const;
  /// The planes near a coordinate; false where cells are too large to tell them apart.
  bool Collect(const Coordinate& coordinate, PlaneWindow* window) const;

  std::shared_ptr<const CoordinatePlanes> planes_;
  std::vector<LearnedScale> weights_;  ///< ln of how much likelier a cell on a plane is

  // The vertex under way.
  uint32_t step_ = 0, known_ = 0;  ///< coordinates coded, and their places
  uint32_t axis_ = 0, shift_ = 0, context_ = 0;
  LearnedScale* weight_ = nullptr;  ///< null: nothing was weighed
  double on_plane_ = 0;             ///< how likely that was
};

template <class Below>
bool PlaneModel::Weigh(const Coordinate& coordinate, const Below& below, PlaneWindow* window) {
  if (planes_ == nullptr) return false;
  axis_ = coordinate.axis;
  shift_ = coordinate.shift;
  weight_ = nullptr;
  if (!Collect(coordinate, window)) return false;
  window->below_first = below(window->first);
  window->below_last = below(window->last);
  double on = 0;
  for (size_t i = 0; i < window->count; ++i) {
    window->added[i] = below(window->cell[i] + 1) - below(window->cell[i]);
    on = on + window->added[i];
  }
  constexpr double kLeastPart = 1.0 / 64, kMostPart = 0.999;
  const double all = window->below_last - window->below_first;
  if (!(on > kLeastPart * all)) return false;
  const Place old = PlaceOf(axis_, shift_, coordinate.old);
  context_ = (known_ * kPlaces + old) * kSteps + step_;
  weight_ = &weights_[context_];
  const double part = std::min(on / all, kMostPart);
  const double heavier = detail::FastExp2(1.44269504 * weight_->mean);
  window->outside = heavier * part + 1 - part;
  on_plane_ = heavier * part / window->outside;
  for (size_t i = 0; i < window->count; ++i) {
    window->added[i] = window->added[i] * (heavier - 1);
  }
  return true;
}

}  // namespace folprom
