// From lessons to the start that would have served them best.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/train/lesson.h"

namespace folprom::train {

struct WeightedLesson {
  std::vector<Piece> pieces;
  double weight = 1;  ///< of all lessons of a scan together 1
};

/// Codes for InitialStatistics. Decisions: place and confidence that make the lessons likeliest, a
/// beta distribution before each. Values and scales: means.
std::vector<int16_t> Merge(const std::vector<WeightedLesson>& lessons);

}  // namespace folprom::train
