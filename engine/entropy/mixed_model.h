// A binary decision predicted by a few contexts that learn and a mixer that learns whom to trust
// (logistic mixing: Mahoney, "Adaptive Weighing of Context Models for Lossless Data Compression",
// 2005). Integers only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/entropy/fixed_math.h"
#include "engine/entropy/learned_state.h"

namespace folprom {

namespace detail {
/// ln(p / (1 - p)) in 1/256 for p = i/4096, and its inverse in 1/65536.
inline constexpr auto kStretch = [] {
  std::array<int16_t, 4096> table{};
  for (size_t i = 0; i < 4096; ++i) {
    double p = (static_cast<double>(i) + 0.5) / 4096;
    double value = Log2Exact(p / (1 - p)) * 0.69314718055994530942 * 256;
    if (value > 2047) value = 2047;
    if (value < -2047) value = -2047;
    table[i] = static_cast<int16_t>(value);
  }
  return table;
}();
inline constexpr auto kSquash = [] {
  std::array<uint16_t, 4096> table{};
  for (int i = 0; i < 4096; ++i) {
    double p = 65536 / (1 + ExpExact(-static_cast<double>(i - 2048) / 256));
    table[static_cast<size_t>(i)] = static_cast<uint16_t>(p < 1 ? 1 : (p > 65535 ? 65535 : p));
  }
  return table;
}();
/// 65536 / (n + 1.6): how far a probability that has seen n decisions moves to the next one.
inline constexpr auto kRate = [] {
  std::array<uint16_t, 256> table{};
  for (int n = 0; n < 256; ++n) {
    table[static_cast<size_t>(n)] = static_cast<uint16_t>(65536 / (n + 1.6));
  }
  return table;
}();
}  // namespace detail

/// N contexts that learn, E predictions from outside, and a mixer with `sets` weight vectors.
template <size_t N, size_t E = 0>
class MixedModel {
 public:
  /// sizes[i]: number of values of context i.
  explicit MixedModel(std::array<uint32_t, N> sizes, uint32_t sets = 1) {
    for (size_t i = 0; i < N; ++i) states_[i].assign(sizes[i], uint32_t{1} << 31);
    weights_.assign(sets, Initial());
  }

  /// predictions: ln(p / (1 - p)) in 1/256, p the probability of `true`; -2047 .. 2047.
  template <class Coder>
  bool Code(Coder& coder, const std::array<uint32_t, N>& contexts, uint32_t set, bool bit,
            const std::array<int32_t, E>& predictions = {}) {
    std::array<uint32_t*, N> state;
    std::array<int32_t, N + E> input;
    std::array<int32_t, N + E>& weight = weights_[set];
    int64_t sum = 0;
    for (size_t i = 0; i < N; ++i) {
      state[i] = &states_[i][contexts[i]];
      input[i] = detail::kStretch[*state[i] >> 20];
    }
    for (size_t i = 0; i < E; ++i) input[N + i] = predictions[i];
    for (size_t i = 0; i < N + E; ++i) sum += static_cast<int64_t>(weight[i]) * input[i];
    int64_t mixed = sum >> 16;
    if (mixed > 2047) mixed = 2047;
    if (mixed < -2047) mixed = -2047;
    int32_t probability = detail::kSquash[static_cast<size_t>(mixed + 2048)];
    bit = coder.Code(static_cast<uint32_t>(probability), bit);
    int32_t error = (bit ? 65536 : 0) - probability;
    for (size_t i = 0; i < N + E; ++i) {
      weight[i] += static_cast<int32_t>((static_cast<int64_t>(input[i]) * error * kLearning) >> 20);
    }
    for (size_t i = 0; i < N; ++i) Update(state[i], bit);
    return bit;
  }

  void Visit(LearnedStateVisitor& visitor) {
    for (auto& states : states_) visitor.Decisions(states);
    for (auto& weight : weights_) visitor.Values(weight, 1024);
  }

 private:
  static constexpr int kLearning = 12;
  /// A probability moves at least by one in so many.
  static constexpr uint32_t kMostSeen = 250;
  static std::array<int32_t, N + E> Initial() {
    std::array<int32_t, N + E> weight;
    const double whole = E > 0 ? 0.4 : (N == 1 ? 1.0 : 1.3);
    weight.fill(static_cast<int32_t>(65536 * whole / static_cast<double>(N)));
    for (size_t i = 0; i < E; ++i)
      weight[N + i] = static_cast<int32_t>(65536 * 0.8 / static_cast<double>(E));
    return weight;
  }
  /// A state is a probability in its upper 22 bits and a count of decisions in its lower 10.
  void Update(uint32_t* state, bool bit) {
    uint32_t count = *state & 1023;
    int32_t probability = static_cast<int32_t>(*state >> 10);
    int32_t target = bit ? (1 << 22) - 1 : 0;
    probability += static_cast<int32_t>(
        (static_cast<int64_t>(target - probability) * detail::kRate[count]) >> 16);
    if (count < kMostSeen) ++count;
    *state = static_cast<uint32_t>(probability) << 10 | count;
  }

  std::array<std::vector<uint32_t>, N> states_;
  std::vector<std::array<int32_t, N + E>> weights_;
};

}  // namespace folprom
