// A binary tree of vertex sets as it grows from its leaves.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/hierarchy/set_tree.h"
#include "engine/mesh/types.h"

namespace folprom {

/// Vertices, joined two sets at a time. A set is named by the vertex that stands for it.
class MergeTree {
 public:
  explicit MergeTree(uint32_t vertices);

  /// The set of `removed` joins that of `kept`. error: distance, lattice units, that this adds to
  /// an LOD; area: of the surface that it applies to.
  void Join(uint32_t kept, uint32_t removed, double error, double area);
  /// Once a single set is left: the tree, each set contiguous, the kept child first. positions: of
  /// the vertices.
  SetTree Flatten(std::span<const Int3> positions) const;

 private:
  struct Merge {
    uint32_t kept, removed;  ///< nodes: the vertices, then the merges
    double distortion;
  };
  double DistortionOf(uint32_t node) const;

  uint32_t vertices_;
  std::vector<Merge> merges_;
  std::vector<uint32_t> node_of_;  ///< per vertex that stands for a set
};

}  // namespace folprom
