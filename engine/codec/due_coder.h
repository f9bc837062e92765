// Early steps ask which sets are due by the error that they make; later ones go by spacing alone.
#pragma once

#include <cstdint>
#include <span>

#include "engine/codec/due_model.h"
#include "engine/codec/subtree_lod.h"
#include "engine/codec/subtree_truth.h"
#include "engine/entropy/initial_statistics.h"
#include "engine/entropy/mixed_model.h"

namespace folprom {

struct DueSettings {
  double always = 0;   ///< vertices up to which steps ask
  double longest = 1;  ///< extent of the lattice along its longest axis
  bool ask_root = true;
};

class DueCoder {
 public:
  explicit DueCoder(const DueSettings& settings);

  /// Starts a step that splits sets down to `least_spacing` (0: all). Are sets asked in it, those
  /// of large spacing too. truth: encoder only.
  template <class Coder>
  bool CodeAsking(Coder& coder, double least_spacing, const SubtreeLod& lod,
                  std::span<const uint32_t> open, const SubtreeTruth* truth);
  /// Is the set of the star split in this step, which asks. spacing: of the set now. Measures the
  /// star's faces.
  template <class Coder>
  bool CodeDue(Coder& coder, SubtreeLod& lod, SetStar* star, double spacing,
               const SubtreeTruth* truth);
  void Visit(LearnedStateVisitor& visitor) { model_.Visit(visitor); }

 private:
  bool IsDue(const SubtreeTruth& truth, uint32_t set) const;
  bool Pays(const SubtreeLod& lod, std::span<const uint32_t> open, const SubtreeTruth& truth) const;
  DueSigns SignsOf(const SubtreeLod& lod, SetStar* star, double spacing) const;

  DueSettings settings_;
  uint32_t step_ = 0;  ///< the first is 1
  double least_spacing_ = 0;
  bool asking_ = false;
  MixedModel<1> still_asking_;
  DueModel model_;
};

}  // namespace folprom
