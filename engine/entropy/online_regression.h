// Linear regression that learns as it goes: both sides see the same samples in the same order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/entropy/learned_state.h"
#include "engine/entropy/least_squares.h"

namespace folprom {

/// Predicts y from K features of size 1e6 or less. Starts from given weights; refits by least
/// squares, older samples fading, each time enough new ones have come.
template <size_t K>
class OnlineRegression {
 public:
  explicit OnlineRegression(const std::array<double, K>& first) : weights_(first), first_(first) {}

  double Predict(const std::array<double, K>& features) const {
    double sum = 0;
    for (size_t i = 0; i < K; ++i) sum = sum + weights_[i] * features[i];
    return sum;
  }
  void Learn(const std::array<double, K>& features, double y) {
    size_t n = 0;
    for (size_t i = 0; i < K; ++i) {
      for (size_t j = i; j < K; ++j) products_[n] = products_[n] + features[i] * features[j], ++n;
      targets_[i] = targets_[i] + features[i] * y;
    }
    if (++fresh_ < kRefit) return;
    fresh_ = 0;
    Refit();
    for (double& value : products_) value = value * kFade;
    for (double& value : targets_) value = value * kFade;
  }

  void Visit(LearnedStateVisitor& visitor) {
    visitor.Values(weights_, 1.0 / 64);
    first_ = weights_;
  }

 private:
  static constexpr uint32_t kRefit = 32;
  static constexpr double kFade = 0.995;
  /// How strongly the weights are held at the first ones.
  static constexpr double kRidge = 2;

  void Refit() {
    std::array<std::array<double, K + 1>, K> a;
    size_t n = 0;
    for (size_t i = 0; i < K; ++i) {
      for (size_t j = i; j < K; ++j) a[i][j] = a[j][i] = products_[n++];
      a[i][i] = a[i][i] + kRidge;
      a[i][K] = targets_[i] + kRidge * first_[i];
    }
    SolvePositive(a, &weights_);
  }

  std::array<double, K> weights_, first_;
  std::array<double, K*(K + 1) / 2> products_{};
  std::array<double, K> targets_{};
  uint32_t fresh_ = 0;
};

}  // namespace folprom
