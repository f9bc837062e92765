#include "engine/codec/tree_truth.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/codec/fit_choice.h"

namespace folprom {
namespace {

/// Where each vertex stands in an order.
std::vector<uint32_t> PlacesIn(const std::vector<uint32_t>& order) {
  std::vector<uint32_t> place(order.size());
  for (uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
  return place;
}

/// Faces inside the subtree, then the inner edges of cross faces as triples (a, b, b), of places.
/// Faces go by their first place: those of a vertex set lie close together in memory, which the
/// oracle's scans are bound by.
std::vector<Face> InnerTriples(const SubtreeChunk& chunk, uint32_t subtree,
                               const std::vector<uint32_t>& place) {
  const auto first_place = [&](const Face& face) {
    return std::min({place[face[0]], place[face[1]], place[face[2]]});
  };
  std::vector<uint32_t> begin(place.size() + 1, 0);
  for (const Face& face : chunk.faces) ++begin[first_place(face) + 1];
  for (size_t i = 0; i < place.size(); ++i) begin[i + 1] += begin[i];
  std::vector<Face> triples(chunk.faces.size());
  for (const Face& face : chunk.faces) {
    triples[begin[first_place(face)]++] = {place[face[0]], place[face[1]], place[face[2]]};
  }
  for (const CrossFace& face : chunk.cross_faces) {
    for (size_t i = 0; i < 3; ++i) {
      const VertexRef &a = face.vertex[i], &b = face.vertex[(i + 1) % 3];
      if (a.subtree == subtree && b.subtree == subtree && a.local != b.local) {
        triples.push_back({place[a.local], place[b.local], place[b.local]});
      }
    }
  }
  return triples;
}

}  // namespace

TreeTruth::TreeTruth(const SubtreeChunk& chunk, uint32_t subtree, const SetTree& tree,
                     const CodecParameters& parameters)
    : chunk_(chunk),
      tree_(tree),
      parameters_(parameters),
      real_faces_(chunk.faces.size()),
      stride_(chunk.attributes.size() / std::max<size_t>(chunk.positions.size(), 1)),
      place_(PlacesIn(tree.order())),
      oracle_(static_cast<uint32_t>(place_.size()), InnerTriples(chunk, subtree, place_)) {
  all_places_.resize(place_.size());
  std::iota(all_places_.begin(), all_places_.end(), 0u);
  std::vector<bool> at_border(chunk.positions.size(), false);
  for (const CrossFace& face : chunk.cross_faces) {
    for (const VertexRef& vertex : face.vertex) {
      if (vertex.subtree == subtree) at_border[vertex.local] = true;
    }
  }
  border_before_.assign(1, 0);
  border_before_.reserve(chunk.positions.size() + 1);
  for (uint32_t vertex : tree.order()) {
    border_before_.push_back(border_before_.back() + (at_border[vertex] ? 1 : 0));
  }
  node_of_set_.reserve(chunk.positions.size());
  node_of_set_.push_back(0);
}

void TreeTruth::PrefetchChildren(uint32_t set) const {
  const SetTree::Node& node = tree_.node(node_of_set_[set]);
  for (uint32_t i = 0; i < node.child_count; ++i) {
    __builtin_prefetch(&tree_.node(node.first_child + i));
  }
}

uint32_t TreeTruth::ChildCount(uint32_t set) const {
  return std::max(tree_.node(node_of_set_[set]).child_count, 1u);
}

Int3 TreeTruth::ChildRepresentative(uint32_t set, uint32_t child) const {
  return tree_.node(tree_.node(node_of_set_[set]).first_child + child).representative;
}

void TreeTruth::BeginSplit(uint32_t set, std::span<const uint32_t> order) {
  parent_ = node_of_set_[set];
  order_.assign(order.begin(), order.end());
}

uint64_t TreeTruth::BorderVertices(std::span<const uint32_t> places) const {
  uint64_t count = 0;
  for (uint32_t place : places) {
    const SetTree::Node& node = tree_.node(tree_.node(parent_).first_child + order_[place]);
    count += border_before_[node.end] - border_before_[node.begin];
  }
  return count;
}

void TreeTruth::BeginBinarySplit(uint32_t set, std::span<const uint32_t> first,
                                 std::span<const uint32_t> second) {
  first_set_ = set;
  first_places_.assign(first.begin(), first.end());
  second_places_.assign(second.begin(), second.end());
  first_border_ = BorderVertices(first) > 0;
  second_border_ = BorderVertices(second) > 0;
  size_t sizes[2] = {0, 0};
  const std::vector<uint32_t>* children[2] = {&first_places_, &second_places_};
  uint32_t first_child = tree_.node(parent_).first_child;
  for (size_t side = 0; side < 2; ++side) {
    for (uint32_t child : *children[side]) {
      const SetTree::Node& node = tree_.node(first_child + order_[child]);
      sizes[side] += node.end - node.begin;
    }
  }
  bool second_is_smaller = sizes[1] <= sizes[0];
  moved_.clear();
  const std::span<const uint32_t> all(all_places_);
  for (uint32_t child : second_is_smaller ? second_places_ : first_places_) {
    const SetTree::Node& node = tree_.node(first_child + order_[child]);
    moved_.push_back(all.subspan(node.begin, node.end - node.begin));
  }
  oracle_.Scan(set, moved_, second_is_smaller);
}

void TreeTruth::EndBinarySplit(uint32_t second_set) {
  node_of_set_.resize(std::max<size_t>(node_of_set_.size(), second_set + size_t{1}));
  uint32_t first_child = tree_.node(parent_).first_child;
  if (first_places_.size() == 1) node_of_set_[first_set_] = first_child + order_[first_places_[0]];
  if (second_places_.size() == 1)
    node_of_set_[second_set] = first_child + order_[second_places_[0]];
}

Int3 TreeTruth::VertexPosition(uint32_t set) const {
  return tree_.node(node_of_set_[set]).representative;
}

const uint8_t* TreeTruth::Attributes(uint32_t set) const {
  // The vertex that stands for a set is its first (MergeTree::Flatten).
  return chunk_.attributes.data() + tree_.VerticesOf(node_of_set_[set])[0] * stride_;
}

FitShares TreeTruth::Fit(const SubtreeLod& lod, std::span<const uint32_t> open,
                         const FitShares& before) const {
  size_t vertices = 0;
  for (const uint32_t set : open) vertices += tree_.VerticesOf(node_of_set_[set]).size();
  const size_t stride = vertices / kFitSamples + 1;
  std::vector<FitSample> samples;
  size_t next = 0;  // of the vertices of the set
  for (const uint32_t set : open) {
    const auto members = tree_.VerticesOf(node_of_set_[set]);
    for (; next < members.size(); next += stride) {
      samples.push_back({set, chunk_.positions[members[next]]});
    }
    next -= members.size();
  }
  return ChooseFit(lod, samples, before);
}

CoordinateRest TreeTruth::Rest(uint32_t set, size_t axis) const {
  const uint32_t vertex = tree_.VerticesOf(node_of_set_[set])[0];
  const int32_t extent[3] = {parameters_.extent.x, parameters_.extent.y, parameters_.extent.z};
  return parameters_.exact->Split(axis, extent[axis], chunk_.exact[vertex][axis]).rest;
}

FaceCensus TreeTruth::CountFaces(const Complex& complex) const {
  return TakeCensus(complex, oracle_, real_faces_);
}

double TreeTruth::LargestDistance(const std::vector<Int3>& positions) const {
  double largest2 = 0;
  // In the order of the tree neighbours have one representative.
  const std::vector<uint32_t>& order = tree_.order();
  for (uint32_t place = 0; place < order.size(); ++place) {
    const Vector3 d =
        Difference(chunk_.positions[order[place]], positions[oracle_.VertexOf(place)]);
    largest2 = std::max(largest2, Dot(d, d));
  }
  return std::sqrt(largest2);
}

std::vector<uint32_t> TreeTruth::FinalVertices() const {
  std::vector<uint32_t> result(chunk_.positions.size());
  for (uint32_t v = 0; v < result.size(); ++v) result[v] = VertexOf(v);
  return result;
}

}  // namespace folprom
