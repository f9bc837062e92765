// How likely each way is in which a split can part a fan, from what is cheap to measure: a
// FanModel of few quantities, each looked up in a table of steps.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/connectivity/fan.h"
#include "engine/connectivity/fan_features.h"
#include "engine/entropy/lanes.h"
#include "engine/entropy/mixed_model.h"

namespace folprom {

class LightFanModel {
 public:
  LightFanModel();

  /// Codes the cut. spokes: by place, the outside has none. second: the second child relative to
  /// the first.
  template <class Coder>
  FanCut Code(Coder& coder, const Fan& fan, std::span<const FanSpoke> spokes, const Vector3& second,
              FanCut truth);

 private:
  static constexpr uint32_t kMost = Fan::kMostPlaces, kGroups = kMost / kLanes;
  static constexpr uint32_t kSteps = 16, kMostDegree = 15, kAges = 16, kRests = 20, kArcs = 12;
  static constexpr uint32_t kPlaceBuckets = 8, kOddsBuckets = 16;
  /// A float per place, with room for whole groups behind the last.
  template <size_t N>
  using Row = std::array<float, N + kLanes>;
  /// Logarithms, base 2, of what the weight of a cut is multiplied with.
  struct Tables {
    std::array<float, kSteps> shape;  ///< of the new triangle at either end of the cut
    std::array<float, kSteps> lean;   ///< of a neighbour that goes to the second child
    std::array<float, kSteps> pivot_lean, pivot_angle;
    std::array<float, kMostDegree + 1> pivot_degree;
    std::array<float, 2 * kAges> pivot_age;
    std::array<float, kRests> pivot_rest;
    std::array<float, kArcs> arc_second, arc_first;  ///< neighbours between the pivots, either way
    std::array<float, 2> outside;                    ///< as a pivot, and inside the second's part
  };
  static const Tables kFirstTables;
  /// Where the quantities of a place lie in their tables.
  struct Steps {
    std::array<int32_t, kMost + kLanes> shape, lean, angle;
    std::array<uint8_t, kMost> degree, age, rest;
  };

  void Measure(const Fan& fan, std::span<const FanSpoke> spokes, const Vector3& second);
  void Weigh(const Fan& fan);
  void WeighArcs();
  /// The likeliest cut, and its part of all.
  FanCut Likeliest(float* part) const;
  template <class Coder>
  FanCut CodeOther(Coder& coder, FanCut likeliest, FanCut truth) const;
  void Learn(const Fan& fan, FanCut truth);
  void LearnPlaces(const Fan& fan, const Row<kMost>& begins, const Row<kMost>& ends,
                   float first_inside);
  uint32_t Distance(FanCut cut) const {
    return cut.end > cut.begin ? cut.end - cut.begin : cut.end + places_ - cut.begin;
  }

  Tables tables_ = kFirstTables;
  MixedModel<2, 1> hit_;

  // The fan under way.
  uint32_t places_ = 0, groups_ = 0;
  Steps steps_;
  Row<2 * kMost> to_;  ///< weight of an end at a place; then of one behind place 0 again
  /// Of a begin, place 0 behind so many that are never one.
  alignas(16) Row<3 * kMost> from_{};
  alignas(16) Row<kMost> arc_;  ///< by distance from begin to end
  /// Of cuts by distance from begin to end, and begin.
  alignas(16) std::array<Row<kMost>, kMost> weight_;
  alignas(16) Row<kMost> begins_;  ///< of all cuts with this begin
  float total_ = 0;
};

}  // namespace folprom
