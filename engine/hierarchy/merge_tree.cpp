#include "engine/hierarchy/merge_tree.h"

#include <algorithm>
#include <utility>

namespace folprom {

MergeTree::MergeTree(uint32_t vertices) : vertices_(vertices), node_of_(vertices) {
  merges_.reserve(vertices);
  for (uint32_t v = 0; v < vertices; ++v) node_of_[v] = v;
}

void MergeTree::Join(uint32_t kept, uint32_t removed, double error, double area) {
  // A set is due no later than the sets inside it.
  const double distortion =
      std::max({area * error, DistortionOf(node_of_[kept]), DistortionOf(node_of_[removed])});
  merges_.push_back({node_of_[kept], node_of_[removed], distortion});
  node_of_[kept] = vertices_ + static_cast<uint32_t>(merges_.size()) - 1;
}

double MergeTree::DistortionOf(uint32_t node) const {
  return node < vertices_ ? 0 : merges_[node - vertices_].distortion;
}

SetTree MergeTree::Flatten(std::span<const Int3> positions) const {
  const size_t count = vertices_ + merges_.size();
  std::vector<uint32_t> size(count, 1), kept_vertex(count);
  for (uint32_t v = 0; v < vertices_; ++v) kept_vertex[v] = v;
  for (uint32_t i = 0; i < merges_.size(); ++i) {
    size[vertices_ + i] = size[merges_[i].kept] + size[merges_[i].removed];
    kept_vertex[vertices_ + i] = kept_vertex[merges_[i].kept];
  }
  std::vector<SetTree::Node> nodes;
  std::vector<uint32_t> order(vertices_);
  nodes.reserve(count);
  // Node of the merges, per node of the tree; the last merge joined everything.
  std::vector<uint32_t> source{static_cast<uint32_t>(count) - 1};
  nodes.push_back({0, vertices_, 0, 0, positions[kept_vertex[source[0]]], 0});
  for (uint32_t i = 0; i < nodes.size(); ++i) {
    if (source[i] < vertices_) {
      order[nodes[i].begin] = source[i];
      continue;
    }
    const Merge& merge = merges_[source[i] - vertices_];
    const uint32_t middle = nodes[i].begin + size[merge.kept], end = nodes[i].end;
    nodes[i].first_child = static_cast<uint32_t>(nodes.size());
    nodes[i].child_count = 2;
    nodes[i].distortion = merge.distortion;
    nodes.push_back({nodes[i].begin, middle, 0, 0, positions[kept_vertex[merge.kept]], 0});
    nodes.push_back({middle, end, 0, 0, positions[kept_vertex[merge.removed]], 0});
    source.push_back(merge.kept);
    source.push_back(merge.removed);
  }
  return {std::move(nodes), std::move(order)};
}

}  // namespace folprom
