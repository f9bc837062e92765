// One subtree: its vertex sets, split round by round, and its single vertices, refined.
//
// Encoder and decoder run the same code; the encoder's answers come from a SubtreeTruth.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/codec/border_record.h"
#include "engine/codec/due_model.h"
#include "engine/codec/leaf_model.h"
#include "engine/codec/parameters.h"
#include "engine/codec/rest_coder.h"
#include "engine/connectivity/complex.h"
#include "engine/connectivity/face_exceptions.h"
#include "engine/connectivity/split_coder.h"
#include "engine/geometry/cylinder_cell.h"
#include "engine/geometry/grid_pattern.h"
#include "engine/geometry/lattice_coder.h"
#include "engine/geometry/offset_coder.h"
#include "engine/geometry/ring_shape.h"
#include "engine/mesh/types.h"

namespace folprom {

/// What the encoder answers. A "set" is named by the LOD vertex that stands for it.
class SubtreeTruth : public RestTruth {
 public:
  virtual Int3 RootRepresentative() const = 0;
  /// The sets come from rows and columns of regular grids.
  virtual bool OnGrid() const = 0;
  /// Number of children of the set, 1 when it is a single vertex.
  virtual uint32_t ChildCount(uint32_t set) const = 0;
  /// What the set adds to the error of an LOD: area times distance, lattice units cubed.
  virtual double Distortion(uint32_t set) const = 0;
  virtual Int3 ChildRepresentative(uint32_t set, uint32_t child) const = 0;
  /// The coder will call the children of the set by their place in `order` (a permutation).
  virtual void BeginSplit(uint32_t set, std::span<const uint32_t> order) = 0;
  /// The next binary split divides `set` into two groups of places; the first keeps its name.
  virtual void BeginBinarySplit(uint32_t set, std::span<const uint32_t> first,
                                std::span<const uint32_t> second) = 0;
  virtual bool FirstTouchesBorder() const = 0;
  virtual bool SecondTouchesBorder() const = 0;
  virtual void EndBinarySplit(uint32_t second_set) = 0;
  /// Position of the only vertex of a set.
  virtual Int3 VertexPosition(uint32_t set) const = 0;
  /// How coarse positions may be, at most `coarsest` bits, while the `open` sets are not split.
  virtual LatticePrecision Precision(const Complex& complex, std::span<const uint32_t> open,
                                     uint32_t coarsest) const = 0;
  virtual SplitOracle* oracle() = 0;
  /// Final faces, in terms of `complex`, for the exceptions.
  virtual FaceCensus CountFaces(const Complex& complex) const = 0;
};

/// Costs in 1/1024 bit. The six kinds in the table of a file are these, root and offsets together,
/// and refinement and rests.
struct CostMeters {
  uint64_t split = 0, root = 0, refinement = 0, exceptions = 0, seams = 0, rests = 0;
  OffsetMeters offsets;
  SplitMeters connectivity;

  CostMeters& operator+=(const CostMeters& other);
};

/// What the table of the file says of a subtree.
struct SubtreeShape {
  uint32_t vertices = 0;
  Int3 box_lo, box_hi;
  bool has_border = false;  ///< does any face reach into another subtree
  /// Faces of the whole mesh: neither faces nor, three times as many, edges can be more.
  uint64_t mesh_faces = ~uint64_t{0} / 4;
};

/// State of one subtree between layers. Memory is proportional to what has been decoded.
class SubtreeCoder {
 public:
  SubtreeCoder(const CodecParameters& parameters, const SubtreeShape& shape);

  /// Codes the next layer. truth and meters: encoder only. The decoder throws Failure kCorrupt.
  template <class Coder>
  void CodeLayer(Coder& coder, SubtreeTruth* truth, CostMeters* meters);

  /// All that the models have learned.
  void Visit(LearnedStateVisitor& visitor);

  uint32_t layers_done() const { return layer_; }
  const std::vector<Int3>& positions() const { return positions_; }
  /// Of an exact encoding with rests, after the last layer; empty otherwise.
  const std::vector<ExactPosition>& exact_positions() const { return exact_positions_; }
  const Complex& complex() const { return complex_; }
  const BorderRecord& border() const { return border_; }
  /// Number of the border set that the vertex stands for, kNone when it touches no other subtree.
  uint32_t BorderOf(uint32_t vertex) const { return sets_[vertex].border; }
  /// The vertex of each border set of the current LOD.
  std::vector<uint32_t> BorderVertices() const;

  /// Faces of the current LOD; after the last split layer those of the original mesh, all of them.
  uint64_t face_count() const;
  void AppendFaces(std::vector<Face>* faces) const;

 private:
  enum SetState : uint8_t { kUnknown = 0, kLeaf = 1 };
  static constexpr float kUnmeasured = 3e38f;
  struct SetRecord {
    float scale = 0;  ///< spacing to assume without neighbours, lattice units
    /// When last measured, never far below the present one; of a leaf, when it was found to be one.
    float spacing = kUnmeasured;
    uint32_t cell = kNone;    ///< index into cells_; kNone: the position is exact
    uint32_t border = kNone;  ///< number of the border set
    uint32_t asked = 0;       ///< the last round in which it was not due, 0: none since its split
    SetState state = kUnknown;
  };

  template <class Coder>
  void CodeRoot(Coder& coder, SubtreeTruth* truth);
  template <class Coder>
  void CodeRound(Coder& coder, double spacing, SubtreeTruth* truth, CostMeters* meters);
  /// Is a set of this spacing split in a round down to `least_spacing`, while few are live.
  /// Are sets asked in this round, those of large spacing too, whether they are split.
  template <class Coder>
  bool CodeAsking(Coder& coder, double least_spacing, const SubtreeTruth* truth);
  bool IsDue(const SubtreeTruth& truth, uint32_t set, double least_spacing) const;
  template <class Coder>
  bool CodeDue(Coder& coder, uint32_t set, double spacing, double least_spacing,
               SubtreeTruth* truth, CostMeters* meters);
  template <class Coder>
  void CodeSet(Coder& coder, uint32_t set, double spacing, SubtreeTruth* truth, CostMeters* meters);
  template <class Coder>
  void CodeChildren(Coder& coder, uint32_t set, uint32_t count, SubtreeTruth* truth,
                    CostMeters* meters);
  /// The split of a set into itself and a new vertex on the lattice.
  template <class Coder>
  void CodeNewVertex(Coder& coder, uint32_t set, SubtreeTruth* truth, CostMeters* meters);
  template <class Coder>
  void CodePrecision(Coder& coder, SubtreeTruth* truth);
  template <class Coder>
  uint32_t CodeFiner(Coder& coder, uint32_t which, uint32_t finer);
  /// Brings every vertex to the precision of the layer.
  template <class Coder>
  void CodeLatticeRefinement(Coder& coder, SubtreeTruth* truth, CostMeters* meters);
  /// Into ring_: the neighbours' positions.
  void CollectRing(uint32_t set);
  RingShape ShapeAround(uint32_t set);
  template <class Coder>
  void CodeBinarySplits(Coder& coder, uint32_t set, SubtreeTruth* truth, CostMeters* meters);
  template <class Coder>
  uint32_t CodeBinarySplit(Coder& coder, uint32_t set, const Int3& first, const Int3& second,
                           const GridHint* hint, SubtreeTruth* truth, CostMeters* meters);
  /// Sets in an order in which each has neighbours before it.
  void OrderAlongSurface();
  /// Is a set of a grid a single vertex.
  template <class Coder>
  bool CodeGridLeaf(Coder& coder, uint32_t set, double spacing, bool leaf);
  template <class Coder>
  void CodeRefinement(Coder& coder, double bound, SubtreeTruth* truth, CostMeters* meters);
  double Spacing(uint32_t set) const;
  DueSigns DueSignsOf(uint32_t set, double spacing, double least_spacing);
  LeafSigns SignsOf(uint32_t set, double spacing);
  void FinishChild(uint32_t place, uint32_t set);

  /// The binary splits by which K children come about (section 3.2 repeats the binary split): the
  /// nearest two are parted last.
  struct Group {
    Int3 position;
    uint32_t first = kNone, second = kNone;  ///< groups inside, kNone for a child
    std::vector<uint32_t> places;
  };
  void GroupChildren(uint32_t count);

  CodecParameters parameters_;
  SubtreeShape shape_;
  uint32_t layer_ = 0;
  uint32_t round_ = 0;  ///< the first is 1

  Complex complex_;
  std::vector<Int3> positions_;
  std::vector<ExactPosition> exact_positions_;
  std::vector<SetRecord> sets_;
  LatticePrecision precision_;
  std::vector<CylinderCell> cells_;
  std::vector<uint32_t> cell_vertex_;
  std::vector<uint32_t> open_;
  BorderRecord border_;
  uint32_t border_sets_ = 0;

  /// Where the sets come from regular grids.
  std::optional<GridPattern> grid_;
  /// Peers that are leaves, that were split since, and what the grid says of a next split.
  MixedModel<3> grid_leaf_;
  SplitCoder split_coder_;
  // One of the two, as settings.offsets says.
  std::optional<LatticeCoder> lattice_coder_;
  std::optional<OffsetCoder> offset_coder_;
  /// Bits by which positions are finer than the schedule says: along the surface, and across it
  /// once more.
  std::array<uint32_t, 2> finer_{0, 0};
  MixedModel<1> finer_same_;
  bool asking_ = false;
  MixedModel<1> still_asking_;
  DueModel due_model_;
  LeafModel leaf_model_;
  MixedModel<1> border_both_;
  MixedModel<1> border_side_;
  FaceExceptions exceptions_;

  // Scratch of one split.
  std::vector<Int3> ring_;
  std::vector<OffsetIndex> offsets_;
  std::vector<CylinderCell> child_cells_;
  std::vector<Int3> child_positions_;
  std::vector<Group> groups_;
  std::vector<uint32_t> order_;
  float child_scale_ = 0;
  bool children_are_leaves_ = false;
};

}  // namespace folprom
