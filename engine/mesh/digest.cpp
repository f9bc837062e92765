#include "engine/mesh/digest.h"

#include <array>
#include <cstring>

#include "io/container/checksum.h"

namespace folprom {
namespace {

template <size_t N>
uint64_t Hash(const std::array<Int3, N>& points) {
  static_assert(sizeof(points) == N * 12);
  return io::XxHash64({reinterpret_cast<const uint8_t*>(points.data()), sizeof points});
}

}  // namespace

void AddVertex(io::MeshDigest* digest, const Int3& position) {
  digest->vertices += Hash(std::array<Int3, 1>{position});
}

void AddFace(io::MeshDigest* digest, Int3 a, Int3 b, Int3 c) {
  std::array<Int3, 3> best{a, b, c};
  for (const auto& turned : {std::array<Int3, 3>{b, c, a}, std::array<Int3, 3>{c, a, b}}) {
    if (turned < best) best = turned;
  }
  digest->faces += Hash(best);
}

}  // namespace folprom
