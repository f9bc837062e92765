#include "engine/codec/plane_census.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "engine/codec/plane_coder.h"
#include "engine/entropy/cell_model.h"

namespace folprom {
namespace {

/// What is held to be a plane saves so many bits at least: the logarithm of how much likelier its
/// vertices are than if as many lay there as at the coordinates around it (Poisson).
constexpr double kLeastBits = 20;
constexpr double kLeastUsual = 0.05;
/// Coordinates around a plane that it is compared with: as many as hold so many vertices.
constexpr double kAround = 100;
constexpr int64_t kLeastReach = 12;
/// A plane costs about so many bits in the table, and what planes save should be seen in the file.
constexpr double kBitsPerPlane = 6, kLeastBitsPerVertex = 0.1;

/// A coordinate and how many vertices have it.
struct Heap {
  int32_t coordinate;
  uint32_t count;
};

std::vector<Heap> HeapsOf(std::vector<int32_t>* coordinates) {
  std::sort(coordinates->begin(), coordinates->end());
  std::vector<Heap> heaps;
  for (int32_t coordinate : *coordinates) {
    if (heaps.empty() || heaps.back().coordinate != coordinate) heaps.push_back({coordinate, 0});
    ++heaps.back().count;
  }
  return heaps;
}

double BitsSaved(double count, double usual) {
  constexpr double kBitsPerNat = 1.44269504;
  if (count <= usual) return 0;
  return kBitsPerNat * (count * detail::FastLog(count / usual) - (count - usual));
}

/// Planes of one axis; none where they would save too little. Sorts the coordinates.
std::vector<int32_t> PlanesAmong(std::vector<int32_t>* coordinates) {
  const std::vector<Heap> heaps = HeapsOf(coordinates);
  const auto vertices = static_cast<double>(coordinates->size());
  const double extent = static_cast<double>(heaps.back().coordinate) - heaps.front().coordinate;
  const int64_t reach = std::max(kLeastReach, static_cast<int64_t>(kAround * extent / vertices));
  std::vector<int32_t> planes;
  double saved = 0;
  size_t first = 0, last = 0, around = 0;  // heaps in reach, and their vertices
  for (const Heap& heap : heaps) {
    while (last < heaps.size() && heaps[last].coordinate <= heap.coordinate + reach) {
      around += heaps[last++].count;
    }
    while (heaps[first].coordinate < heap.coordinate - reach) around -= heaps[first++].count;
    const double others = static_cast<double>(around - heap.count) / static_cast<double>(2 * reach);
    const double bits = BitsSaved(static_cast<double>(heap.count), std::max(others, kLeastUsual));
    if (bits < kLeastBits) continue;
    planes.push_back(heap.coordinate);
    saved += bits - kBitsPerPlane;
  }
  if (planes.size() > kMostPlanes || saved < kLeastBitsPerVertex * vertices) planes.clear();
  return planes;
}

}  // namespace

std::shared_ptr<const CoordinatePlanes> FindPlanes(std::span<const Int3> positions) {
  std::array<std::vector<int32_t>, 3> planes;
  std::vector<int32_t> coordinates;
  for (uint32_t axis = 0; axis < 3; ++axis) {
    coordinates.clear();
    for (const Int3& position : positions) coordinates.push_back(At(position, axis));
    planes[axis] = PlanesAmong(&coordinates);
  }
  auto found = std::make_shared<CoordinatePlanes>(std::move(planes));
  if (found->empty()) return nullptr;
  return found;
}

}  // namespace folprom
