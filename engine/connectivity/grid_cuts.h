// Cuts of fans on regular grids: fans that look alike are cut alike.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/connectivity/fan.h"
#include "engine/connectivity/split_star.h"
#include "engine/entropy/mixed_model.h"
#include "engine/geometry/grid_pattern.h"

namespace folprom {

class GridCuts {
 public:
  GridCuts();

  /// Looks the fan up. Its places are told by what their neighbours are to the splits that agree,
  /// counted from the neighbour beyond. False: that one is not in the fan.
  bool Find(const Fan& fan, const SplitStar& star, const GridHint& hint);
  /// Codes whether the fan is cut like the last ones that look alike, and returns it; places 0 and
  /// 0 when it is not, or when there is none.
  template <class Coder>
  FanCut Code(Coder& coder, const Fan& fan, FanCut truth);
  /// Takes the cut of the fan found last; returns the kind of the split, GridHint::kind.
  uint8_t Learn(const Fan& fan, const GridHint& hint, FanCut cut);

 private:
  static constexpr uint32_t kEntries = 4096, kMostHits = 15;
  struct Entry {
    FanCut cut;         ///< places counted from the neighbour beyond
    uint32_t hits = 0;  ///< halved at each miss
  };
  std::vector<Entry> entries_;
  MixedModel<2> hit_;
  uint32_t entry_ = 0, beyond_ = 0;  ///< of the fan found last
};

}  // namespace folprom
