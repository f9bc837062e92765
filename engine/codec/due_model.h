// Is a vertex set split in this round although it could wait, or the other way round?
#pragma once

#include <cstdint>

#include "engine/entropy/mixed_model.h"

namespace folprom {

/// What both sides know of the set. Lengths over the spacing of the round.
struct DueSigns {
  double spacing = 0;     ///< mean distance to the neighbours
  double scale = 0;       ///< how far from its sibling it was made
  double distortion = 0;  ///< length that stands for the distortion of a set as bent as its ring
  bool asked = false;     ///< it was asked in the round before, and was not due
  uint32_t split = 0;     ///< neighbours that were split or made since that round began
  uint32_t waiting = 0;   ///< neighbours that were asked and are not due
};

/// Learns from each answer.
class DueModel {
 public:
  DueModel();
  template <class Coder>
  bool Code(Coder& coder, const DueSigns& signs, bool due);
  void Visit(LearnedStateVisitor& visitor) { model_.Visit(visitor); }

 private:
  MixedModel<5> model_;
};

}  // namespace folprom
