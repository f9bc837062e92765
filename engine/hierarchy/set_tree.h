// The hierarchy of vertex sets of one subtree, whatever made it.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/mesh/types.h"

namespace folprom {

/// The vertex sets of one subtree. Node 0 holds all vertices; a node of one vertex has no children.
class SetTree {
 public:
  struct Node {
    uint32_t begin = 0, end = 0;  ///< vertices, into order()
    uint32_t first_child = 0;
    uint32_t child_count = 0;  ///< 0 or 2 .. K, consecutive nodes
    Int3 representative;
    double distortion = 0;  ///< SubtreeTruth::Distortion
  };
  SetTree(std::vector<Node> nodes, std::vector<uint32_t> order)
      : nodes_(std::move(nodes)), order_(std::move(order)) {}
  /// The sets come from rows and columns of regular grids.
  bool on_grid() const { return on_grid_; }
  void SetOnGrid(bool on_grid) { on_grid_ = on_grid; }
  const Node& node(uint32_t index) const { return nodes_[index]; }
  std::span<const uint32_t> VerticesOf(uint32_t index) const {
    return std::span(order_).subspan(nodes_[index].begin, nodes_[index].end - nodes_[index].begin);
  }
  /// Vertices in such an order that each set is contiguous.
  const std::vector<uint32_t>& order() const { return order_; }

 private:
  std::vector<Node> nodes_;
  std::vector<uint32_t> order_;
  bool on_grid_ = false;
};

}  // namespace folprom
