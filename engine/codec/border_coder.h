// Which of the two sets of a split touch other subtrees, and the record of it for the seams.
#pragma once

#include <cstdint>

#include "engine/codec/border_record.h"
#include "engine/connectivity/complex.h"
#include "engine/entropy/initial_statistics.h"
#include "engine/entropy/mixed_model.h"
#include "engine/mesh/types.h"

namespace folprom {

/// A binary split of a set that touches other subtrees.
struct BorderSplit {
  Int3 first, second;
  uint32_t degree = 0;  ///< edges of the first, at most kMostDegree
  uint32_t gaps = 0;    ///< of GapsOf()
  bool connected = false;
  bool first_touches = false, second_touches = false;  ///< encoder only
};

/// How open the surface is at both children: where a subtree ends its own faces leave a gap, and a
/// set that they enclose seldom touches another subtree. 0 .. BorderCoder::kGaps - 1.
uint32_t GapsOf(const Complex& complex, uint32_t first, uint32_t second);

class BorderCoder {
 public:
  static constexpr uint32_t kMostDegree = 15, kGaps = 16;

  BorderCoder();

  /// The subtree has a border: its root is border set 0.
  void AddRoot(const Int3& position);
  /// Parts the border set *first; kNone where a side touches no other subtree.
  template <class Coder>
  void CodeSplit(Coder& coder, const BorderSplit& split, uint32_t* first, uint32_t* second);
  void EndLayer() { record_.layer_end.push_back(static_cast<uint32_t>(record_.events.size())); }
  void Visit(LearnedStateVisitor& visitor);

  const BorderRecord& record() const { return record_; }
  uint32_t set_count() const { return set_count_; }

 private:
  BorderRecord record_;
  uint32_t set_count_ = 0;
  MixedModel<2> both_;
  MixedModel<1> side_;
};

}  // namespace folprom
