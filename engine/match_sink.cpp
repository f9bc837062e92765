#include "engine/match_sink.h"

#include <algorithm>

#include "io/container/checksum.h"

namespace folprom {

uint64_t HashFace(std::array<uint64_t, 3> face) {
  std::array<uint64_t, 3> best = face;
  for (int i = 0; i < 2; ++i) {
    face = {face[1], face[2], face[0]};
    best = std::min(best, face);
  }
  return io::XxHash64({reinterpret_cast<const uint8_t*>(best.data()), sizeof best});
}

void MatchSink::AddSubtree(const SubtreePart& part) {
  digest.AddSubtree(part);
  std::vector<ExactPosition> xyz(part.positions.size());
  for (size_t v = 0; v < xyz.size(); ++v) xyz[v] = part.Position(lattice_, v);
  streams_.Append(0, xyz.data(), xyz.size() * sizeof(ExactPosition));
  streams_.Append(1, part.attributes.data(), part.attributes.size());
  base.push_back(vertices_);
  border_.emplace_back(part.border_vertices.begin(), part.border_vertices.end());
  for (const Face& f : part.faces) {
    face_sum += HashFace({vertices_ + f[0], vertices_ + f[1], vertices_ + f[2]});
  }
  vertices_ += part.positions.size();
}

void MatchSink::AddSeam(std::span<const SeamFace> faces) {
  digest.AddSeam(faces);
  auto index = [&](const BorderRef& r) { return base[r.subtree] + border_[r.subtree][r.border]; };
  for (const SeamFace& f : faces) face_sum += HashFace({index(f[0]), index(f[1]), index(f[2])});
}

}  // namespace folprom
