// Which of the numbers 0 .. n - 1 are not used yet, with their ranks.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace folprom {

/// A bit a number, and a Fenwick tree over runs of 512 of them. Each call takes O(log n).
class UnusedSet {
 public:
  explicit UnusedSet(uint32_t count) : left_(count) {
    const size_t runs = count / kRunNumbers + size_t{1};
    words_.assign(runs * kRunWords, 0);
    for (uint32_t i = 0; i < count / 64; ++i) words_[i] = ~uint64_t{0};
    if (count % 64 != 0) words_[count / 64] = (uint64_t{1} << count % 64) - 1;
    tree_.assign(runs + 1, 0);
    for (size_t run = 0; run < runs; ++run) {
      tree_[run + 1] += CountIn(run);
      const size_t above = (run + 1) + ((run + 1) & (~run));
      if (above <= runs) tree_[above] += tree_[run + 1];
    }
  }

  /// How many there are.
  uint32_t left() const { return left_; }
  bool Has(uint32_t number) const { return (words_[number / 64] >> number % 64 & 1) != 0; }

  /// The number must be there.
  void Remove(uint32_t number) { Turn(number, ~uint32_t{0}); }
  /// The number must not be there.
  void PutBack(uint32_t number) { Turn(number, 1); }

  /// How many of them are below `number`.
  uint32_t Rank(uint32_t number) const {
    uint32_t rank = 0;
    for (size_t i = number / kRunNumbers; i > 0; i &= i - 1) rank += tree_[i];
    for (size_t word = number / kRunNumbers * kRunWords; word < number / 64; ++word) {
      rank += static_cast<uint32_t>(std::popcount(words_[word]));
    }
    const uint64_t below = (uint64_t{1} << number % 64) - 1;
    return rank + static_cast<uint32_t>(std::popcount(words_[number / 64] & below));
  }

  /// The one that has `rank` others below it; rank < left().
  uint32_t Select(uint32_t rank) const {
    size_t run = 0;
    for (size_t step = std::bit_floor(tree_.size() - 1); step > 0; step /= 2) {
      if (run + step < tree_.size() && tree_[run + step] <= rank) {
        run += step;
        rank -= tree_[run];
      }
    }
    size_t word = run * kRunWords;
    while (rank >= static_cast<uint32_t>(std::popcount(words_[word]))) {
      rank -= static_cast<uint32_t>(std::popcount(words_[word++]));
    }
    uint64_t bits = words_[word];
    for (; rank > 0; --rank) bits &= bits - 1;
    return static_cast<uint32_t>(word * 64) + static_cast<uint32_t>(std::countr_zero(bits));
  }

 private:
  static constexpr size_t kRunWords = 8;
  static constexpr uint32_t kRunNumbers = 64 * kRunWords;

  /// step: 1 or, modulo 2^32, -1.
  void Turn(uint32_t number, uint32_t step) {
    words_[number / 64] ^= uint64_t{1} << number % 64;
    left_ += step;
    for (size_t i = number / kRunNumbers + size_t{1}; i < tree_.size(); i += i & (~i + 1)) {
      tree_[i] += step;
    }
  }

  uint32_t CountIn(size_t run) const {
    uint32_t count = 0;
    for (size_t i = 0; i < kRunWords; ++i) {
      count += static_cast<uint32_t>(std::popcount(words_[run * kRunWords + i]));
    }
    return count;
  }

  std::vector<uint64_t> words_;
  std::vector<uint32_t> tree_;  ///< [i]: of the runs i - lowest bit of i .. i - 1
  uint32_t left_;
};

}  // namespace folprom
