// The paper's hierarchy: vertex sets split top-down by the generalized Lloyd algorithm (section 2.1).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/hierarchy/surface.h"
#include "engine/mesh/types.h"
#include "folprom/settings.h"

namespace folprom {

/// The vertex sets of one subtree. Node 0 holds all vertices; a node of one vertex has no children.
class SetTree {
 public:
  struct Node {
    uint32_t begin = 0, end = 0;  ///< vertices, into order()
    uint32_t first_child = 0;
    uint32_t child_count = 0;     ///< 0 or 2 .. K, consecutive nodes
    Int3 representative;
    double distortion = 0;  ///< SubtreeTruth::Distortion
  };
  const Node& node(uint32_t index) const { return nodes_[index]; }
  std::span<const uint32_t> VerticesOf(uint32_t index) const {
    return std::span(order_).subspan(nodes_[index].begin, nodes_[index].end - nodes_[index].begin);
  }
  /// Vertices in such an order that each set is contiguous.
  const std::vector<uint32_t>& order() const { return order_; }

 private:
  friend class LloydBuilder;
  std::vector<Node> nodes_;
  std::vector<uint32_t> order_;
};

/// `longest_side`: of the whole mesh's box in lattice units; the metric sees it as 4096. At least one
/// vertex. Single-threaded and the same on every machine.
SetTree BuildLloydTree(std::span<const Int3> positions, const SurfaceAttributes& surface,
                       double longest_side, const CodecSettings& settings);

}  // namespace folprom
