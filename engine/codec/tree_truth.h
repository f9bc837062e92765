// The encoder's answers for one subtree, from its tree of vertex sets.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/codec/lattice_precision.h"
#include "engine/codec/parameters.h"
#include "engine/codec/plane_census.h"
#include "engine/codec/subtree_truth.h"
#include "engine/connectivity/split_oracle.h"
#include "engine/hierarchy/lloyd_tree.h"
#include "engine/partition/partition.h"

namespace folprom {

/// Answers a SubtreeCoder<BitEncoder>. Keeps references to all that it is given.
class TreeTruth final : public SubtreeTruth {
 public:
  TreeTruth(const SubtreeChunk& chunk, uint32_t subtree, const SetTree& tree,
            const CodecParameters& parameters);

  Int3 RootRepresentative() const override { return tree_.node(0).representative; }
  bool OnGrid() const override { return tree_.on_grid(); }
  void PrefetchSet(uint32_t set) const override { __builtin_prefetch(&node_of_set_[set]); }
  void PrefetchNode(uint32_t set) const override {
    __builtin_prefetch(&tree_.node(node_of_set_[set]));
  }
  void PrefetchChildren(uint32_t set) const override;
  uint32_t ChildCount(uint32_t set) const override;
  double Distortion(uint32_t set) const override {
    return tree_.node(node_of_set_[set]).distortion;
  }
  Int3 ChildRepresentative(uint32_t set, uint32_t child) const override;
  void BeginSplit(uint32_t set, std::span<const uint32_t> order) override;
  void BeginBinarySplit(uint32_t set, std::span<const uint32_t> first,
                        std::span<const uint32_t> second) override;
  bool FirstTouchesBorder() const override { return first_border_; }
  bool SecondTouchesBorder() const override { return second_border_; }
  void EndBinarySplit(uint32_t second_set) override;
  Int3 VertexPosition(uint32_t set) const override;
  const uint8_t* Attributes(uint32_t set) const override;
  LatticePrecision Precision(const Complex& complex, std::span<const uint32_t> open,
                             uint32_t coarsest) const override {
    return ChoosePrecision(complex, *this, open, coarsest);
  }
  FitShares Fit(const SubtreeLod& lod, std::span<const uint32_t> open,
                const FitShares& before) const override;
  std::shared_ptr<const CoordinatePlanes> Planes() const override {
    return FindPlanes(chunk_.positions);
  }
  SplitOracle* oracle() override { return &oracle_; }
  CoordinateRest Rest(uint32_t set, size_t axis) const override;
  FaceCensus CountFaces(const Complex& complex) const override;

  /// LOD vertex that stands for a vertex of the chunk.
  uint32_t VertexOf(uint32_t original) const { return oracle_.VertexOf(place_[original]); }
  /// Largest distance, lattice units, of an original vertex from its representative.
  double LargestDistance(const std::vector<Int3>& positions) const;
  /// After all splits: index in the decoded subtree of each vertex of the chunk.
  std::vector<uint32_t> FinalVertices() const;

 private:
  uint64_t BorderVertices(std::span<const uint32_t> places) const;

  const SubtreeChunk& chunk_;
  const SetTree& tree_;
  const CodecParameters& parameters_;
  size_t real_faces_;
  size_t stride_;  ///< bytes of the attributes of a vertex
  // The oracle numbers vertices by their place in tree.order().
  std::vector<uint32_t> place_, all_places_;
  SplitOracle oracle_;
  std::vector<uint32_t> border_before_;  ///< border vertices among the first i of tree_.order()
  std::vector<uint32_t> node_of_set_;    ///< node of the tree, valid for sets that are one node
  // The split under way: the node whose children are being parted, and those children in their
  // order.
  uint32_t parent_ = 0;
  std::vector<uint32_t> order_;
  std::vector<uint32_t> first_places_, second_places_;
  std::vector<std::span<const uint32_t>> moved_;
  uint32_t first_set_ = 0;
  bool first_border_ = false, second_border_ = false;
};

}  // namespace folprom
