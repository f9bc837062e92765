#include "engine/mesh/digest.h"

#include <array>
#include <bit>
#include <cstring>
#include <vector>

#include "io/container/checksum.h"

namespace folprom {
namespace {

using Bits3 = std::array<uint64_t, 3>;

template <class Point, size_t N>
uint64_t Hash(const std::array<Point, N>& points) {
  static_assert(sizeof(Int3) == 12 && sizeof(Bits3) == 24, "no byte between the numbers");
  return io::XxHash64({reinterpret_cast<const uint8_t*>(points.data()), sizeof points});
}

template <class Point>
uint64_t HashFace(const Point& a, const Point& b, const Point& c) {
  std::array<Point, 3> best{a, b, c};
  for (const auto& turned : {std::array<Point, 3>{b, c, a}, std::array<Point, 3>{c, a, b}}) {
    if (turned < best) best = turned;
  }
  return Hash(best);
}

/// Position and attributes of a vertex are hashed as one run of bytes.
template <class Point>
void AddEach(io::MeshDigest* digest, std::span<const Point> positions,
             std::span<const uint8_t> attributes) {
  if (attributes.empty()) {
    for (const Point& position : positions) AddVertex(digest, position);
    return;
  }
  const size_t stride = attributes.size() / positions.size();
  std::vector<uint8_t> bytes(sizeof(Point) + stride);
  for (size_t v = 0; v < positions.size(); ++v) {
    std::memcpy(bytes.data(), &positions[v], sizeof(Point));
    std::memcpy(bytes.data() + sizeof(Point), &attributes[v * stride], stride);
    digest->vertices += io::XxHash64(bytes);
  }
}

}  // namespace

void AddVertices(io::MeshDigest* digest, std::span<const Int3> positions,
                 std::span<const uint8_t> attributes) {
  AddEach(digest, positions, attributes);
}

void AddVertices(io::MeshDigest* digest, std::span<const ExactPosition> positions,
                 std::span<const uint8_t> attributes) {
  AddEach(digest, positions, attributes);
}

void AddVertex(io::MeshDigest* digest, const Int3& position) {
  digest->vertices += Hash(std::array<Int3, 1>{position});
}

void AddFace(io::MeshDigest* digest, Int3 a, Int3 b, Int3 c) { digest->faces += HashFace(a, b, c); }

void AddVertex(io::MeshDigest* digest, const ExactPosition& position) {
  digest->vertices += Hash(std::array<Bits3, 1>{std::bit_cast<Bits3>(position)});
}

void AddFace(io::MeshDigest* digest, const ExactPosition& a, const ExactPosition& b,
             const ExactPosition& c) {
  digest->faces +=
      HashFace(std::bit_cast<Bits3>(a), std::bit_cast<Bits3>(b), std::bit_cast<Bits3>(c));
}

}  // namespace folprom
