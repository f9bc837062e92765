// Many short lists that grow and shrink, each contiguous, all in one pool.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace folprom {

/// Lists named by number, of values that are small. A list takes 2^k blocks of eight values; blocks
/// that it gives back go to lists that grow.
template <class T>
class BlockLists {
 public:
  void AddList() { lists_.push_back({}); }
  uint32_t size() const { return static_cast<uint32_t>(lists_.size()); }
  uint32_t SizeOf(uint32_t list) const { return lists_[list].size; }
  /// Valid until a value is appended to any list.
  std::span<const T> Of(uint32_t list) const { return {ValuesOf(lists_[list]), lists_[list].size}; }
  T& At(uint32_t list, uint32_t place) { return ValuesOf(lists_[list])[place]; }

  /// Asks for the memory that Prefetch will read, and that Of will; say so early.
  void PrefetchList(uint32_t list) const { __builtin_prefetch(&lists_[list]); }
  void Prefetch(uint32_t list) const { __builtin_prefetch(ValuesOf(lists_[list])); }

  /// Returns the place of the value.
  uint32_t Append(uint32_t list, const T& value) {
    List& grown = lists_[list];
    if (grown.size == kBlock * grown.blocks) Grow(&grown);
    ValuesOf(grown)[grown.size] = value;
    return grown.size++;
  }
  /// Fills the place with the last value of the list, unless it is the last.
  void Remove(uint32_t list, uint32_t place) {
    List& shrunk = lists_[list];
    T* values = ValuesOf(shrunk);
    values[place] = values[--shrunk.size];
  }
  /// Keeps the first so many values.
  void Shrink(uint32_t list, uint32_t size) { lists_[list].size = size; }
  void Swap(uint32_t a, uint32_t b) { std::swap(lists_[a], lists_[b]); }
  /// Appends all values of a list to another and leaves it empty and without blocks.
  void MoveAll(uint32_t from, uint32_t to) {
    for (uint32_t i = 0; i < lists_[from].size; ++i) Append(to, T{At(from, i)});
    Release(lists_[from]);
    lists_[from] = {};
  }

 private:
  static constexpr uint32_t kBlock = 8;
  struct List {
    uint32_t begin = 0, blocks = 0;
    uint32_t size = 0;
  };
  struct alignas(kBlock * sizeof(T)) Block {
    std::array<T, kBlock> values;
  };
  // Null while the pool is empty.
  const T* ValuesOf(const List& list) const {
    return reinterpret_cast<const T*>(pool_.data()) + Offset(list);
  }
  T* ValuesOf(const List& list) { return reinterpret_cast<T*>(pool_.data()) + Offset(list); }
  static size_t Offset(const List& list) { return size_t{list.begin} * kBlock; }

  void Release(const List& list) {
    if (list.blocks == 0) return;
    free_[static_cast<size_t>(std::countr_zero(list.blocks))].push_back(list.begin);
  }
  void Grow(List* list) {
    const uint32_t blocks = std::max(2 * list->blocks, 1u);
    auto& free = free_[static_cast<size_t>(std::countr_zero(blocks))];
    uint32_t begin = static_cast<uint32_t>(pool_.size());
    if (free.empty()) {
      pool_.resize(pool_.size() + blocks);
    } else {
      begin = free.back();
      free.pop_back();
    }
    std::copy_n(pool_.begin() + list->begin, list->blocks, pool_.begin() + begin);
    Release(*list);
    list->begin = begin;
    list->blocks = blocks;
  }

  std::vector<List> lists_;
  std::vector<Block> pool_;
  std::array<std::vector<uint32_t>, 32> free_;  ///< runs of 2^k blocks
};

}  // namespace folprom
