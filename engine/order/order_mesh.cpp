#include "engine/order/order_mesh.h"

#include <numeric>

#include "folprom/result.h"

namespace folprom {
namespace {

/// Bits of a coordinate that the curve goes by.
constexpr int kCurveBits = 21;

/// Two zero bits between each two bits.
uint64_t Spread(uint64_t value) {
  value = (value | value << 32) & 0x1f00000000ffff;
  value = (value | value << 16) & 0x1f0000ff0000ff;
  value = (value | value << 8) & 0x100f00f00f00f00f;
  value = (value | value << 4) & 0x10c30c30c30c30c3;
  return (value | value << 2) & 0x1249249249249249;
}

uint64_t CurveKey(const Int3& p, const Int3& origin, int shift) {
  const auto part = [&](int32_t value, int32_t from) {
    return Spread((static_cast<uint64_t>(value) - static_cast<uint64_t>(from)) >> shift);
  };
  return part(p.x, origin.x) | part(p.y, origin.y) << 1 | part(p.z, origin.z) << 2;
}

/// By their smallest corner into buckets, then each bucket. begins: memory.
void SortFaces(std::span<const Face> faces, std::span<uint32_t> begins, std::span<Face> sorted,
               WorkSpace& space) {
  for (const Face& face : faces) {
    ++begins[std::ranges::min(face)];
    space.Stepped(1);
  }
  std::inclusive_scan(begins.begin(), begins.end(), begins.begin());
  for (size_t f = faces.size(); f-- > 0;) {
    Face face = faces[f];
    TurnToSmallest(&face);
    sorted[--begins[face[0]]] = face;
    space.Stepped(1);
  }
  for (size_t v = 0; v + 1 < begins.size(); ++v) {
    std::ranges::sort(sorted.subspan(begins[v], begins[v + 1] - begins[v]));
    space.Stepped(1);
  }
}

std::span<const uint32_t> ListStars(std::span<const Face> faces, std::span<uint32_t> begins,
                                    std::span<uint32_t> stars, WorkSpace& space) {
  const auto each_corner = [](const Face& face, auto use) {
    use(face[0]);
    if (face[1] != face[0]) use(face[1]);
    if (face[2] != face[0] && face[2] != face[1]) use(face[2]);
  };
  std::ranges::fill(begins, 0u);
  for (const Face& face : faces) {
    each_corner(face, [&](uint32_t v) { ++begins[v]; });
    space.Stepped(1);
  }
  // The ends, which become the begins as the lists fill from behind.
  std::inclusive_scan(begins.begin(), begins.end(), begins.begin());
  for (size_t f = faces.size(); f-- > 0;) {
    each_corner(faces[f], [&](uint32_t v) { stars[--begins[v]] = static_cast<uint32_t>(f); });
    space.Stepped(1);
  }
  return stars.first(begins.back());
}

}  // namespace

std::vector<uint32_t> CurvePlaces(std::span<const Int3> positions,
                                  std::span<const uint32_t> numbers) {
  struct Place {
    uint64_t key;
    uint32_t vertex;
  };
  std::vector<uint32_t> places(positions.size());
  if (positions.empty()) return places;
  Int3 lo = positions[0], hi = positions[0];
  for (const Int3& p : positions) {
    for (uint32_t axis = 0; axis < 3; ++axis) {
      At(lo, axis) = std::min(At(lo, axis), At(p, axis));
      At(hi, axis) = std::max(At(hi, axis), At(p, axis));
    }
  }
  int shift = 0;
  for (uint32_t axis = 0; axis < 3; ++axis) {
    while ((At(hi, axis) - At(lo, axis)) >> shift >> kCurveBits != 0) ++shift;
  }
  std::vector<Place> order(positions.size());
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = {CurveKey(positions[i], lo, shift), i};
  std::ranges::sort(order, [&](const Place& a, const Place& b) {
    if (a.key != b.key) return a.key < b.key;
    if (positions[a.vertex] != positions[b.vertex]) {
      return positions[a.vertex] < positions[b.vertex];
    }
    return numbers[a.vertex] < numbers[b.vertex];
  });
  for (uint32_t place = 0; place < order.size(); ++place) places[order[place].vertex] = place;
  return places;
}

void CheckOrderable(uint64_t vertices, uint64_t faces, const std::string& file) {
  if (vertices <= kMostOrdered && faces <= kMostOrdered) return;
  throw Failure(ErrorKind::kLimit, file + ": the order of " + std::to_string(vertices) +
                                       " vertices and " + std::to_string(faces) +
                                       " faces cannot be kept, of at most " +
                                       std::to_string(kMostOrdered) + " it can");
}

uint32_t OrderMesh::NumberOf(Face face) const {
  TurnToSmallest(&face);
  return static_cast<uint32_t>(std::ranges::lower_bound(faces, face) - faces.begin());
}

std::vector<uint32_t> OrderMesh::Numbers(std::span<const Face> some) const {
  std::vector<uint32_t> numbers;
  for (const Face& face : some) numbers.push_back(NumberOf(face));
  return numbers;
}

OrderMesh MakeOrderMesh(std::span<const Int3> positions, std::span<const Face> faces,
                        WorkSpace& space) {
  const std::span<uint32_t> begins = space.Words(positions.size() + 1);
  const std::span<Face> sorted = space.Faces(faces.size());
  SortFaces(faces, begins, sorted, space);
  const std::span<uint32_t> stars = space.Words(3 * faces.size());
  return {positions, sorted, begins, ListStars(sorted, begins, stars, space)};
}

}  // namespace folprom
