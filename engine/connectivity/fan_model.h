// How likely each way is in which a split can part a fan.
//
// A log-linear model over all cuts: what the triangles and edges after the split look like (shape,
// angles, bends), how many edges meet at its vertices and how old these are adds up, each by a
// piecewise linear function. The weights at its knots learn from each cut.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/connectivity/fan.h"
#include "engine/connectivity/fan_features.h"
#include "engine/entropy/mixed_model.h"

namespace folprom {

class FanModel {
 public:
  FanModel();

  /// Codes the cut. spokes: by place, the outside has none. second: the second child relative to
  /// the first.
  template <class Coder>
  FanCut Code(Coder& coder, const Fan& fan, std::span<const FanSpoke> spokes,
              const Vector3& second, FanCut truth);
  void Visit(LearnedStateVisitor& visitor);

 private:
  using Features = FanFeatures;
  static constexpr uint32_t kMost = Fan::kMostPlaces, kGroups = Features::kGroups;
  static constexpr uint32_t kMostArc = 11;
  // Where the weights of each quantity begin. The shapes of triangles have one more, for those that
  // are turned over.
  static constexpr uint32_t kKnots = Features::kKnots, kAgeKnots = Features::kAgeKnots;
  static constexpr uint32_t kShapeFirst = 0, kShapeSecond = kShapeFirst + kKnots + 1,
                            kShapeNew = kShapeSecond + kKnots + 1,
                            kAnglesFirst = kShapeNew + kKnots + 1,
                            kAnglesPivotFirst = kAnglesFirst + kKnots,
                            kAnglesPivotSecond = kAnglesPivotFirst + kKnots,
                            kAnglePivot = kAnglesPivotSecond + kKnots,
                            kBendFirst = kAnglePivot + kKnots, kBendSecond = kBendFirst + kKnots,
                            kBendPivot = kBendSecond + kKnots, kBendNew = kBendPivot + kKnots,
                            kLeanFirst = kBendNew + kKnots, kLeanSecond = kLeanFirst + kKnots,
                            kDegree = kLeanSecond + kKnots,
                            kAge = kDegree + Features::kMostDegree + 1,
                            kRest = kAge + 2 * kAgeKnots, kArcFirst = kRest + kAgeKnots,
                            kArcSecond = kArcFirst + kMostArc + 1,
                            kOutside = kArcSecond + kMostArc + 1, kWeights = kOutside + 3;
  /// A weight that stays 0. There is one more behind each weight, since a value lies between two.
  static constexpr uint32_t kNowhere = kWeights;
  static constexpr uint32_t kStored = (kWeights + 2 + 7) / 8 * 8;
  struct Table {
    uint32_t begin, knots;
  };
  static const std::array<Table, Features::kRoles> kTables;
  /// For four places: which weight, and the share of the one after it.
  struct Terms {
    LaneIntegers weight;
    Lanes share;
  };
  Lanes Interpolate(Table table, Lanes knot, Terms* terms) const;
  Lanes Sum(uint32_t first, uint32_t last, uint32_t group);
  void Weigh(const Fan& fan);
  /// Returns the sum of all.
  float WeighCuts(const Fan& fan, const AroundFan& as_begin, const AroundFan& as_end, float wrapped);
  FanCut TakeLikeliest(uint32_t places, float* probability);
  void Learn(const Fan& fan, FanCut truth);
  void LearnPairs(const Fan& fan, FanCut truth);
  void Spread(uint32_t first, uint32_t last, const AroundFan& error);
  void Add(uint32_t weight, float share, float error);
  void Step();

  alignas(16) std::array<float, kStored> weights_{}, gradient_{}, squares_{};
  MixedModel<2, 1> hit_;

  // The fan under way.
  Features features_;
  uint32_t groups_ = 0;
  Terms terms_[Features::kRoles][kGroups];
  Terms bend_[kMost][kGroups];  ///< between the two new triangles
  /// By the number of neighbours between the pivots, first of cuts that hold place 0 inside.
  std::array<float, 2 * kMost + kLanes> arc_;
  /// Per cut; of those not asked for yet, while they are coded.
  using Cuts = std::array<std::array<float, kMost>, kMost>;
  alignas(16) Cuts probability_, left_;
  std::array<Lanes, kMost> most_left_;  ///< of left_ with a begin; 0 where none is
};

}  // namespace folprom
