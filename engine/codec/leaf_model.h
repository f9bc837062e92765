// Is a vertex set that is due to be split a single vertex?
#pragma once

#include <cstdint>
#include <optional>

#include "engine/entropy/mixed_model.h"

namespace folprom {

/// What both sides know of the set. Lengths in lattice units.
struct LeafSigns {
  double spacing = 0;        ///< mean distance to the neighbours
  double scale = 0;          ///< how far from its sibling it was made
  double bend = 0;           ///< height of the ring over its spacing; not of a light model
  double leaf_spacing = 0;   ///< mean over leaf neighbours of their spacing when they were asked
  double leaf_distance = 0;  ///< mean distance to leaf neighbours
  uint32_t leaves = 0;       ///< neighbours that are leaves
  uint32_t others = 0;
};

/// Learns from each answer. light: goes by half as many contexts, none of which are the bend and
/// the distance of leaves.
class LeafModel {
 public:
  explicit LeafModel(bool light);
  template <class Coder>
  bool Code(Coder& coder, const LeafSigns& signs, bool leaf);
  void Visit(LearnedStateVisitor& visitor) { model_.Visit(visitor); }

 private:
  MixedModel<6> model_;
  std::optional<MixedModel<3>> light_;  ///< instead
};

}  // namespace folprom
