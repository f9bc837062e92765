// Where models start: at what other meshes taught, instead of at nothing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/entropy/learned_state.h"

namespace folprom {

/// One small number for each piece of state, in the order of the walk; 0 leaves it as it is.
/// Of a probability: 1 + 8 * place + confidence, the place among kPlaces and the confidence among
/// kConfidences. Of a value: by how many steps it starts higher. Of a scale: in 1/128.
class InitialStatistics {
 public:
  static constexpr int32_t kPlaces = 64;
  /// Numbers of decisions that a start counts for.
  static constexpr std::array<uint32_t, 8> kConfidences{1, 2, 4, 8, 16, 32, 64, 128};
  static constexpr double kScaleStep = 1.0 / 128;
  /// Of a scale: samples that a start counts for.
  static constexpr double kScaleConfidence = 8;
  /// ln(p / (1 - p)) at a place.
  static constexpr double OddsAt(int32_t place) { return (place - 31.5) * 0.2; }

  explicit InitialStatistics(std::vector<int16_t> codes) : codes_(std::move(codes)) {}
  /// Those of format version 1, made by `folprom_train` (trained_statistics.inc).
  static const InitialStatistics& Trained();

  std::span<const int16_t> codes() const { return codes_; }

 private:
  std::vector<int16_t> codes_;
};

/// Gives state its start.
class StatisticsLoader : public LearnedStateVisitor {
 public:
  explicit StatisticsLoader(const InitialStatistics& statistics) : codes_(statistics.codes()) {}
  void Decisions(std::span<uint32_t> states) override;
  void Values(std::span<int32_t> values, int32_t step) override;
  void Values(std::span<float> values, float step) override;
  void Values(std::span<double> values, double step) override;
  void Scales(std::span<LearnedScale> scales) override;

  /// Codes that nothing has asked for yet.
  size_t left() const { return codes_.size() - next_; }

 private:
  int16_t Next() { return next_ < codes_.size() ? codes_[next_++] : int16_t{0}; }
  std::span<const int16_t> codes_;
  size_t next_ = 0;
};

}  // namespace folprom
