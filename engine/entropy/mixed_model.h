// A binary decision predicted by a few contexts that learn and a mixer that learns whom to trust
// (logistic mixing: Mahoney, "Adaptive Weighing of Context Models for Lossless Data Compression",
// 2005). Integers only.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/entropy/fixed_math.h"
#include "engine/entropy/learned_state.h"
#include "engine/entropy/probability_map.h"

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

/// What may have the last word on a probability: this leaves it as it is.
struct NoLastWord {
  uint32_t Weigh(uint32_t probability) const { return probability; }
  void Learn(bool) const {}
};

/// N contexts that learn, E predictions from outside, and a mixer with `sets` weight vectors. With
/// two mixers what a second one says, whose weights go by how much the contexts have seen, is
/// averaged in, with three also a third's, whose weights go by the second context; a map then
/// corrects the outcome halfway.
template <size_t N, size_t E = 0>
class MixedModel {
 public:
  /// sizes[i]: number of values of context i.
  explicit MixedModel(std::array<uint32_t, N> sizes, uint32_t sets = 1, uint32_t mixers = 1)
      : map_(mixers > 1 ? sets : 0, detail::kSquash) {
    for (size_t i = 0; i < N; ++i) states_[i].assign(sizes[i], uint32_t{1} << 31);
    weights_.assign(sets, Initial());
    if (mixers > 1) others_.emplace_back(kSeenSets, Initial());
    if (mixers > 2) others_.emplace_back(sizes[kThirdContext], Initial());
  }

  /// predictions: ln(p / (1 - p)) in 1/256, p the probability of `true`; -2047 .. 2047. last_word:
  /// turns the probability into the one that is coded, in 1/65536, and hears how it came out.
  template <class Coder, class LastWord = NoLastWord>
  bool Code(Coder& coder, const std::array<uint32_t, N>& contexts, uint32_t set, bool bit,
            const std::array<int32_t, E>& predictions = {}, LastWord last_word = {}) {
    std::array<uint32_t*, N> state;
    std::array<int32_t, N + E> input;
    Weights& weight = weights_[set];
    for (size_t i = 0; i < N; ++i) {
      state[i] = &states_[i][contexts[i]];
      input[i] = detail::kStretch[*state[i] >> 20];
    }
    for (size_t i = 0; i < E; ++i) input[N + i] = predictions[i];
    int64_t sum = Mix(weight, input);
    std::array<Weights*, kMostOthers> other;
    std::array<int32_t, kMostOthers> said;
    if (!others_.empty()) {
      const std::array<size_t, kMostOthers> sets{SeenSet(state), contexts[kThirdContext]};
      for (size_t k = 0; k < others_.size(); ++k) {
        other[k] = &others_[k][sets[k]];
        const int64_t own = Mix(*other[k], input);
        said[k] = Squash(Odds(own));
        sum += own;
      }
      sum /= static_cast<int64_t>(others_.size()) + 1;
    }
    const int32_t odds = Odds(sum), mixed = Squash(odds);
    // Inside 1 .. 65535: mixed is no nearer to either end than 21.
    const int32_t probability = map_.empty() ? mixed : (mixed + map_.Refine(set, odds)) / 2;
    bit = coder.Code(last_word.Weigh(static_cast<uint32_t>(probability)), bit);
    last_word.Learn(bit);
    if (!map_.empty()) map_.Learn(bit);
    const int32_t outcome = bit ? 65536 : 0;
    Learn<kLearning>(input, outcome - mixed, &weight);
    for (size_t k = 0; k < others_.size(); ++k) {
      Learn<kOthersLearning>(input, outcome - said[k], other[k]);
    }
    for (size_t i = 0; i < N; ++i) Update(state[i], bit);
    return bit;
  }

  void Visit(LearnedStateVisitor& visitor) {
    for (auto& states : states_) visitor.Decisions(states);
    for (auto& weight : weights_) visitor.Values(weight, 1024);
  }

 private:
  using Weights = std::array<int32_t, N + E>;
  static constexpr int kLearning = 20, kOthersLearning = 30;
  static constexpr size_t kMostOthers = 2, kThirdContext = N > 1 ? 1 : 0;
  /// Sets of the second mixer: four steps of how much each of the first three contexts has seen.
  static constexpr size_t kSeenContexts = N < 3 ? N : 3, kSeenSets = size_t{1} << 2 * kSeenContexts;
  /// A probability moves at least by one in so many.
  static constexpr uint32_t kMostSeen = 250;
  static Weights Initial() {
    Weights weight;
    const double whole = E > 0 ? 0.4 : (N == 1 ? 1.0 : 1.3);
    weight.fill(static_cast<int32_t>(65536 * whole / static_cast<double>(N)));
    for (size_t i = 0; i < E; ++i)
      weight[N + i] = static_cast<int32_t>(65536 * 0.8 / static_cast<double>(E));
    return weight;
  }
  static size_t SeenSet(const std::array<uint32_t*, N>& state) {
    size_t set = 0;
    for (size_t i = 0; i < kSeenContexts; ++i) {
      const uint32_t seen = *state[i] & 1023;
      set = set * 4 + (seen < 4 ? 0 : (seen < 20 ? 1 : (seen < 120 ? 2 : 3)));
    }
    return set;
  }
  static int64_t Mix(const Weights& weight, const Weights& input) {
    int64_t sum = 0;
    for (size_t i = 0; i < N + E; ++i) sum += static_cast<int64_t>(weight[i]) * input[i];
    return sum;
  }
  static int32_t Odds(int64_t sum) {
    return static_cast<int32_t>(std::clamp<int64_t>(sum >> 16, -2047, 2047));
  }
  static int32_t Squash(int32_t odds) { return detail::kSquash[static_cast<size_t>(odds + 2048)]; }
  template <int kRate>
  static void Learn(const Weights& input, int32_t error, Weights* weight) {
    for (size_t i = 0; i < N + E; ++i) {
      (*weight)[i] += static_cast<int32_t>((static_cast<int64_t>(input[i]) * error * kRate) >> 20);
    }
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
  std::vector<Weights> weights_;
  std::vector<std::vector<Weights>> others_;  ///< of the mixers after the first
  ProbabilityMap map_;                        ///< empty with one mixer
};

}  // namespace folprom
