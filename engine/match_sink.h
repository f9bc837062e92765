// A decoded mesh as it is compared with a scan vertex by vertex.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/mesh_sinks.h"
#include "io/spill/spill.h"

namespace folprom {

/// Hash of a face by the indices of its vertices, the same for every rotation.
uint64_t HashFace(std::array<uint64_t, 3> face);

/// Spills decoded positions, model units, and attributes, and sums the faces by their decoded
/// vertex indices.
class MatchSink final : public MeshSink {
 public:
  MatchSink(const Lattice& lattice, const io::SpillDirectory& spill)
      : digest(lattice), lattice_(lattice), streams_(spill, "decoded", 2, uint64_t{1} << 20) {}
  void AddSubtree(const SubtreePart& part) override;
  void AddSeam(std::span<const SeamFace> faces) override;

  /// No part after it.
  void Finish() { streams_.Finish(); }
  /// All of them, in the order of the decoded mesh.
  io::MappedFile MapPositions() { return streams_.Map(0); }
  io::MappedFile MapAttributes() { return streams_.Map(1); }

  DigestSink digest;
  std::vector<uint64_t> base;  ///< per subtree: its first vertex
  uint64_t face_sum = 0;

 private:
  Lattice lattice_;
  io::SpillStreams streams_;  ///< 0: positions, 1: attributes
  uint64_t vertices_ = 0;
  std::vector<std::vector<uint32_t>> border_;
};

}  // namespace folprom
