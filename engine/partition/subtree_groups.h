// Sorts what one block holds by subtree, so that each subtree gets it in one piece.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace folprom::partition {

/// A stable counting sort. Keeps its memory from block to block.
template <class T>
class SubtreeGroups {
 public:
  /// Forgets the last block. `most_items` bounds the calls of Add.
  void Start(size_t subtree_count, size_t most_items) {
    for (uint32_t subtree : subtrees_) count_[subtree] = 0;
    subtrees_.clear();
    count_.resize(subtree_count);
    end_.resize(subtree_count);
    if (most_items > items_.size()) {
      items_.resize(most_items);
      keys_.resize(most_items);
      sorted_.resize(most_items);
    }
    size_ = 0;
  }

  /// Returns how many items the subtree had before in this block.
  uint32_t Add(uint32_t subtree, const T& item) {
    if (count_[subtree] == 0) subtrees_.push_back(subtree);
    keys_[size_] = subtree;
    items_[size_++] = item;
    return count_[subtree]++;
  }

  void Sort() {
    uint32_t begin = 0;
    for (uint32_t subtree : subtrees_) {
      end_[subtree] = begin;
      begin += count_[subtree];
    }
    for (size_t i = 0; i < size_; ++i) sorted_[end_[keys_[i]]++] = items_[i];
  }

  /// Those with items, each once.
  std::span<const uint32_t> subtrees() const { return subtrees_; }
  /// After Sort: the subtree's items in the order of Add.
  std::span<const T> Items(uint32_t subtree) const {
    return {sorted_.data() + (end_[subtree] - count_[subtree]), count_[subtree]};
  }

 private:
  std::vector<uint32_t> count_, end_;  // per subtree
  std::vector<uint32_t> subtrees_;
  std::vector<uint32_t> keys_;
  std::vector<T> items_, sorted_;
  size_t size_ = 0;
};

}  // namespace folprom::partition
