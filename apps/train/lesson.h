// What one subtree teaches: the state of all models of a coder that started from nothing.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "engine/entropy/learned_state.h"

namespace folprom::train {

enum class Kind : uint8_t { kDecision, kValue, kScale };

/// One piece of state. Of a decision: the probability of `true`, and the number seen. Of a value:
/// by how many steps it lies above its beginning. Of a scale: the same, and the number of samples.
struct Piece {
  Kind kind = Kind::kDecision;
  double value = 0;
  double count = 0;
};

/// Takes the whole state down at each visit. A piece that has seen kEnough keeps what it was then:
/// a start serves what comes first, not the finest layers.
class Lesson : public LearnedStateVisitor {
 public:
  /// beginning: of a coder that has coded nothing; empty for that coder itself.
  explicit Lesson(std::vector<Piece> beginning = {}) : beginning_(std::move(beginning)) {}
  /// Before each walk over the state.
  void BeginVisit() { next_ = 0; }

  void Decisions(std::span<uint32_t> states) override;
  void Values(std::span<int32_t> values, int32_t step) override;
  void Values(std::span<float> values, float step) override;
  void Values(std::span<double> values, double step) override;
  void Scales(std::span<LearnedScale> scales) override;

  const std::vector<Piece>& pieces() const { return pieces_; }

 private:
  static constexpr double kEnough = 40;
  double Beginning(size_t i) const { return beginning_.empty() ? 0 : beginning_[i].value; }
  void Note(const Piece& piece);

  std::vector<Piece> beginning_;
  std::vector<Piece> pieces_;
  size_t next_ = 0;
};

}  // namespace folprom::train
