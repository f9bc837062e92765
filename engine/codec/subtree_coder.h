// One subtree: its vertex sets, split round by round, and its single vertices, refined.
//
// Encoder and decoder run the same code; the encoder's answers come from a SubtreeTruth.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/attributes/attribute_coder.h"
#include "engine/codec/border_coder.h"
#include "engine/codec/cost_meters.h"
#include "engine/codec/cylinder_children.h"
#include "engine/codec/due_coder.h"
#include "engine/codec/grid_coder.h"
#include "engine/codec/leaf_model.h"
#include "engine/codec/lod_fit.h"
#include "engine/codec/parameters.h"
#include "engine/codec/precision_coder.h"
#include "engine/codec/rest_coder.h"
#include "engine/codec/subtree_lod.h"
#include "engine/codec/subtree_truth.h"
#include "engine/connectivity/face_exceptions.h"
#include "engine/connectivity/split_coder.h"
#include "engine/geometry/lattice_coder.h"
#include "engine/mesh/lattice.h"
#include "engine/mesh/types.h"

namespace folprom {

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
  const std::vector<Int3>& positions() const { return lod_.positions; }
  /// Of an exact encoding with rests, after the last layer; empty otherwise.
  const std::vector<ExactPosition>& exact_positions() const { return exact_positions_; }
  /// Where the vertices of the LOD are drawn, model units; empty where it is at positions().
  /// error_bound: of the layer, model units.
  std::vector<ExactPosition> DrawnPositions(const Lattice& lattice, double error_bound) const;
  const Complex& complex() const { return lod_.complex; }
  const BorderRecord& border() const { return border_.record(); }
  /// Of the vertices of the LOD, vertex by vertex as the file has them; empty without any.
  std::vector<uint8_t> Attributes() const {
    return attributes_ ? attributes_->Values() : std::vector<uint8_t>();
  }
  /// Number of the border set that the vertex stands for, kNone when it touches no other subtree.
  uint32_t BorderOf(uint32_t vertex) const { return lod_.sets[vertex].border; }
  /// The vertex of each border set of the current LOD.
  std::vector<uint32_t> BorderVertices() const;

  /// Faces of the current LOD; after the last split layer those of the original mesh, all of them.
  uint64_t face_count() const;
  void AppendFaces(std::vector<Face>* faces) const;

 private:
  template <class Coder>
  void CodeRoot(Coder& coder, SubtreeTruth* truth);
  // In subtree_rounds.cpp.
  /// The splits of a layer.
  template <class Coder>
  void CodeSplits(Coder& coder, SubtreeTruth* truth, CostMeters* meters);
  void RememberSpacings();
  void PrefetchBehind(size_t place, double least_spacing, const SubtreeTruth* truth) const;
  /// Splits sets down to a spacing; 0: all.
  template <class Coder>
  void CodeRound(Coder& coder, double least_spacing, SubtreeTruth* truth, CostMeters* meters);
  /// A step that does not ask, down to a spacing.
  void BeginRounds(double least_spacing);
  /// A step that asks.
  void BeginShares(double least_spacing);
  /// Asks the layer's share of the open sets whether they are split.
  template <class Coder>
  void CodeShare(Coder& coder, SubtreeTruth* truth, CostMeters* meters);
  /// Asks the set, and those that it is split into.
  template <class Coder>
  void AskFamily(Coder& coder, uint32_t set, SubtreeTruth* truth, CostMeters* meters);
  /// Sets in an order in which each has neighbours before it.
  void OrderAlongSurface();
  /// Is a single vertex or is split. Its star's spokes are measured.
  template <class Coder>
  void CodeSet(Coder& coder, uint32_t set, double spacing, SubtreeTruth* truth, CostMeters* meters);
  /// Number of children, 1 for a single vertex. The hint is set for sets of a grid.
  template <class Coder>
  uint32_t CodeChildCount(Coder& coder, uint32_t set, double spacing, uint32_t count,
                          GridHint* hint);
  template <class Coder>
  void CodeChildren(Coder& coder, uint32_t set, uint32_t count, SubtreeTruth* truth,
                    CostMeters* meters);
  /// The split of a set into itself and a new vertex on the lattice.
  template <class Coder>
  void CodeNewVertex(Coder& coder, uint32_t set, const GridHint& hint, SubtreeTruth* truth,
                     CostMeters* meters);
  /// Returns the second of the two sets.
  template <class Coder>
  uint32_t CodeBinarySplit(Coder& coder, uint32_t set, const Int3& first, const Int3& second,
                           const GridHint* hint, SubtreeTruth* truth, CostMeters* meters);
  template <class Coder>
  void CodeBorder(Coder& coder, uint32_t first, uint32_t second, const SubtreeTruth* truth);
  template <class Coder>
  void CodePrecision(Coder& coder, const SubtreeTruth* truth);
  /// Brings every vertex to the precision of the layer.
  template <class Coder>
  void CodeLatticeRefinement(Coder& coder, const SubtreeTruth* truth);
  /// Once, where enough is known for the planes to tell something.
  template <class Coder>
  void CodePlanes(Coder& coder, const SubtreeTruth* truth);
  template <class Coder>
  void CodeFit(Coder& coder, const SubtreeTruth* truth);
  template <class Coder>
  void CodeEndOfSplits(Coder& coder, const SubtreeTruth* truth);

  CodecParameters parameters_;
  SubtreeShape shape_;
  uint32_t layer_ = 0;

  SubtreeLod lod_;
  std::vector<ExactPosition> exact_positions_;
  std::vector<uint32_t> open_;
  // Of the step under way.
  bool asking_ = false;
  std::vector<float> open_spacings_;    ///< as the records of open_ have them, in rounds
  std::vector<double> round_spacings_;  ///< of the rounds that are left, the last first
  struct Share {
    size_t waiting = 0;       ///< the first so many of open_ were asked
    std::vector<bool> large;  ///< were those behind them large enough when the step began
  };
  Share share_;
  std::vector<uint32_t> family_, asked_;  // scratch
  SetStar star_;                          ///< of the set under way
  size_t refined_ = 0;  ///< the first so many vertices have the precision of this step

  SplitCoder split_coder_;
  // One of the two, as settings.offsets says; grid_ with the first, where sets come from grids.
  std::optional<LatticeCoder> lattice_coder_;
  std::optional<CylinderChildren> cylinder_children_;
  std::optional<GridCoder> grid_;
  std::optional<AttributeCoder> attributes_;
  PrecisionCoder precision_;
  bool has_told_planes_ = false;
  std::optional<LodFit> fit_;
  size_t fitted_size_ = 0;  ///< of the LOD whose shares were told last
  DueCoder due_;
  LeafModel leaf_model_;
  BorderCoder border_;
  FaceExceptions exceptions_;
};

}  // namespace folprom
