#include "engine/codec/child_groups.h"

#include <array>
#include <utility>

namespace folprom {
namespace {

int32_t FloorMean(int64_t sum, int64_t count) {
  return static_cast<int32_t>(sum / count);  // coordinates are never negative
}

uint64_t SquaredDistance(const Int3& a, const Int3& b) {
  int64_t x = int64_t{a.x} - b.x, y = int64_t{a.y} - b.y, z = int64_t{a.z} - b.z;
  return static_cast<uint64_t>(x * x) + static_cast<uint64_t>(y * y) + static_cast<uint64_t>(z * z);
}

/// Of the groups `live`: places in it of the nearest two, the earliest of several.
std::pair<size_t, size_t> NearestPair(const std::vector<ChildGroup>& groups,
                                      const std::vector<uint32_t>& live) {
  std::pair<size_t, size_t> pair{0, 1};
  uint64_t nearest = ~uint64_t{0};
  for (size_t i = 0; i < live.size(); ++i) {
    for (size_t j = i + 1; j < live.size(); ++j) {
      uint64_t distance = SquaredDistance(groups[live[i]].position, groups[live[j]].position);
      if (distance < nearest) {
        nearest = distance;
        pair = {i, j};
      }
    }
  }
  return pair;
}

}  // namespace

std::vector<ChildGroup> GroupChildren(std::span<const Int3> positions) {
  std::vector<ChildGroup> groups;
  std::vector<uint32_t> live;
  std::vector<std::array<int64_t, 3>> sums;
  for (uint32_t i = 0; i < positions.size(); ++i) {
    const Int3& p = positions[i];
    groups.push_back({p, kNone, kNone, {i}});
    sums.push_back({p.x, p.y, p.z});
    live.push_back(i);
  }
  while (live.size() > 1) {
    const auto [left, right] = NearestPair(groups, live);
    ChildGroup merged;
    merged.first = live[left];
    merged.second = live[right];
    merged.places = groups[merged.first].places;
    const auto& more = groups[merged.second].places;
    merged.places.insert(merged.places.end(), more.begin(), more.end());
    std::array<int64_t, 3> sum;
    for (size_t i = 0; i < 3; ++i) sum[i] = sums[merged.first][i] + sums[merged.second][i];
    int64_t members = static_cast<int64_t>(merged.places.size());
    merged.position = {FloorMean(sum[0], members), FloorMean(sum[1], members),
                       FloorMean(sum[2], members)};
    live[left] = static_cast<uint32_t>(groups.size());
    live.erase(live.begin() + static_cast<std::ptrdiff_t>(right));
    groups.push_back(std::move(merged));
    sums.push_back(sum);
  }
  return groups;
}

}  // namespace folprom
