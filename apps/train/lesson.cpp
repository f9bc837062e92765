#include "apps/train/lesson.h"

#include "engine/entropy/initial_statistics.h"

namespace folprom::train {

void Lesson::Note(const Piece& piece) {
  if (next_ == pieces_.size()) {
    pieces_.push_back(piece);
  } else if (piece.kind == Kind::kValue || pieces_[next_].count < kEnough) {
    pieces_[next_] = piece;
  }
  ++next_;
}

void Lesson::Decisions(std::span<uint32_t> states) {
  for (uint32_t state : states) {
    Note({Kind::kDecision, static_cast<double>(state >> 10) / (1 << 22),
          static_cast<double>(state & 1023)});
  }
}

void Lesson::Values(std::span<int32_t> values, int32_t step) {
  for (int32_t v : values) {
    Note({Kind::kValue, static_cast<double>(v) / step - Beginning(next_), 1});
  }
}

void Lesson::Values(std::span<float> values, float step) {
  for (float v : values) {
    Note({Kind::kValue, static_cast<double>(v / step) - Beginning(next_), 1});
  }
}

void Lesson::Values(std::span<double> values, double step) {
  for (double v : values) Note({Kind::kValue, v / step - Beginning(next_), 1});
}

void Lesson::Scales(std::span<LearnedScale> scales) {
  for (const LearnedScale& scale : scales) {
    Note(
        {Kind::kScale, scale.mean / InitialStatistics::kScaleStep - Beginning(next_), scale.count});
  }
}

}  // namespace folprom::train
