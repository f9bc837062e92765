// Where the vertices of an LOD are drawn. Faces between vertices of a curved mesh lie on its inner
// side; an LOD whose vertices stand off the mesh, on the outer side, is nearer to it. How far off
// is a share of a vertex's height over its neighbours. The encoder measures the shares and tells
// them layer by layer; the coded positions stay what they are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "engine/codec/subtree_lod.h"
#include "engine/entropy/mixed_model.h"

namespace folprom {

/// Vertices are told apart by how bent the surface is at them: flat, bent, sharp ..
inline constexpr size_t kBends = 4;
/// A share is a whole number of these.
inline constexpr double kShareStep = 0.06;
inline constexpr uint32_t kLargestShare = 7;
/// Of each bend, 0 .. kLargestShare.
using FitShares = std::array<uint32_t, kBends>;
/// What the error bound of a layer holds beside the distance between vertices and their
/// representatives, and how far of it a vertex may be moved: each has its part.
inline constexpr double kShiftPart = 0.2;

/// How an open set is moved: `shift` times the share of its bend; lattice units.
struct FitMove {
  uint32_t set = 0;
  uint32_t bend = 0;
  Vector3 shift{0, 0, 0};
};

/// Of an open set that faces of the subtree surround; no other set is moved.
std::optional<FitMove> FitMoveOf(const SubtreeLod& lod, uint32_t set);

class LodFit {
 public:
  LodFit() : same_({kBends}) {}

  /// Shares of the layer; chosen: encoder only.
  template <class Coder>
  void Code(Coder& coder, const FitShares& chosen);
  const FitShares& shares() const { return shares_; }
  /// What the set moves by, no further than `longest`; lattice units.
  Vector3 ShiftOf(const FitMove& move, double longest) const;

 private:
  FitShares shares_{};
  MixedModel<1> same_;
};

}  // namespace folprom
