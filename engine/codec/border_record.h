// What seams need to know of a subtree: the splits of those sets that touch other subtrees.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/connectivity/complex.h"
#include "engine/mesh/types.h"

namespace folprom {

/// A binary split of a border set. Border sets are numbered by their first appearance: the root is
/// 0, the second child of a split in which both children are border sets gets the next number.
struct BorderEvent {
  uint32_t border = 0;  ///< number of the split set
  uint32_t both = 0;    ///< 1: both children are border sets, and the second gets a new number
  Int3 first_position;  ///< of the two, after the split
  Int3 second_position;
  uint32_t connected = 0;  ///< are the two children connected
};

/// All border events of a subtree, layer after layer. Trivially copyable parts, so that it can be
/// spilled as it is.
struct BorderRecord {
  std::vector<BorderEvent> events;
  std::vector<uint32_t> layer_end;  ///< events up to and with each layer
  Int3 root_position;

  uint32_t LayerBegin(uint32_t layer) const {
    if (layer == 0 || layer_end.empty()) return 0;
    return LayerEnd(layer - 1);
  }
  uint32_t LayerEnd(uint32_t layer) const {
    if (layer_end.empty()) return 0;
    return layer < layer_end.size() ? layer_end[layer] : layer_end.back();
  }
};

}  // namespace folprom
