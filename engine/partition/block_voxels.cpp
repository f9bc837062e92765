#include "engine/partition/block_voxels.h"

#include <algorithm>

namespace folprom::partition {
namespace {

constexpr size_t kFirstTableSize = 1024;

}  // namespace

void BlockVoxels::Clear() {
  entries_.clear();
  table_.assign(kFirstTableSize, kEmpty);
  last_ = 0;
}

uint32_t BlockVoxels::Find(const Int3& coordinate) {
  if (uint32_t known = Slot(coordinate); known != kEmpty) return known;
  if (2 * (entries_.size() + 1) > table_.size()) Grow();
  const auto number = static_cast<uint32_t>(entries_.size());
  Slot(coordinate) = number;
  entries_.push_back({coordinate, {}});
  return number;
}

uint32_t& BlockVoxels::Slot(const Int3& coordinate) {
  const uint64_t key = static_cast<uint64_t>(coordinate.x) |
                       static_cast<uint64_t>(coordinate.y) << 21 |
                       static_cast<uint64_t>(coordinate.z) << 42;
  const uint64_t mixed = key * 0x9E3779B97F4A7C15u;
  const size_t mask = table_.size() - 1;
  size_t at = static_cast<size_t>(mixed >> 32) & mask;
  while (table_[at] != kEmpty && entries_[table_[at]].coordinate != coordinate) {
    at = (at + 1) & mask;
  }
  return table_[at];
}

void BlockVoxels::Grow() {
  table_.assign(4 * table_.size(), kEmpty);
  for (uint32_t number = 0; number < entries_.size(); ++number) {
    Slot(entries_[number].coordinate) = number;
  }
}

}  // namespace folprom::partition
