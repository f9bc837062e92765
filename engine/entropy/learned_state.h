// What the models of a subtree have learned, as one walk over all of it in a fixed order: to start
// them from what other meshes taught, and to collect what a mesh teaches.
#pragma once

#include <cstdint>
#include <span>

namespace folprom {

/// Mean size of something, from so many samples.
struct LearnedScale {
  double mean = 1;
  double count = 0;
};

/// Visits state of one kind at a time. Changes are kept.
class LearnedStateVisitor {
 public:
  virtual ~LearnedStateVisitor() = default;
  /// Probabilities of `true` in the upper 22 bits, numbers of decisions seen in the lower 10.
  virtual void Decisions(std::span<uint32_t> states) = 0;
  /// Values that start at something and move by amounts of about `step` and more.
  virtual void Values(std::span<int32_t> values, int32_t step) = 0;
  virtual void Values(std::span<float> values, float step) = 0;
  virtual void Values(std::span<double> values, double step) = 0;
  virtual void Scales(std::span<LearnedScale> scales) = 0;
};

}  // namespace folprom
