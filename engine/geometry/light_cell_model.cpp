#include "engine/geometry/light_cell_model.h"

namespace folprom {

LightCellModel::Row LightCellModel::FirstRow() {
  constexpr uint32_t kSeen = 6;
  constexpr int kPerOctave = 4;
  Row row;
  for (uint32_t step = 0; step < kSteps; ++step) {
    // The middle of the step.
    const auto octave = static_cast<int>(step / kPerOctave);
    const double part = 1 + (step % kPerOctave + 0.5) / kPerOctave;
    const double odds = std::ldexp(part, kLeastOdds + octave);
    row[step] = PlainStateOf(odds / (1 + odds), kSeen);
  }
  return row;
}

LightCellModel::LightCellModel(uint32_t sides) {
  static const Row kFirst = FirstRow();
  for (auto* rows : {&upper_, &first_[0], &first_[1]}) rows->assign(sides, kFirst);
  for (auto* rows : {&further_, &nearer_half_}) {
    for (auto& octaves : *rows) octaves.fill(kFirst);
  }
}

}  // namespace folprom
