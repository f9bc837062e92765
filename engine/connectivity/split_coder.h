// Codes the connectivity of one binary split (section 3.2) and applies it to the complex.
//
// Beyond the paper, faces are part of the state: a face of an LOD exists exactly when an original
// face joins its three sets. So a mesh whose edges form many more 3-cliques than faces costs time
// and bits by its faces, and no LOD shows a clique that is not a face.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/connectivity/complex.h"
#include "engine/connectivity/fan.h"
#include "engine/connectivity/fan_model.h"
#include "engine/connectivity/grid_cuts.h"
#include "engine/connectivity/light_fan_model.h"
#include "engine/connectivity/split_oracle.h"
#include "engine/connectivity/split_star.h"
#include "engine/entropy/mixed_model.h"
#include "engine/entropy/value_tally.h"
#include "engine/mesh/types.h"

namespace folprom {

/// Which techniques are on: fans parted at once, and two of the paper's.
struct ConnectivitySettings {
  bool fan_cuts = true;
  bool pivot_order = true;
  bool nearer_child = true;
  bool light = false;  ///< cuts of fans by the LightFanModel
};

/// Pivot flags (context: number of neighbours and place in the order, both at most 15) and side
/// flags.
struct SplitTally {
  ValueTally pivots, sides;
};

/// Costs of connectivity in 1/1024 bit.
struct SplitMeters {
  uint64_t connected = 0, pivots = 0, sides = 0;
  SplitTally* tally = nullptr;  ///< encoder only; not null: takes the flags

  uint64_t Sum() const { return connected + pivots + sides; }
};

/// Learning state of the connectivity decisions, kept from layer to layer.
class SplitCoder {
 public:
  explicit SplitCoder(ConnectivitySettings settings);

  /// What is known of the split before its connectivity.
  struct Known {
    Int3 first;   ///< position of the first child
    Int3 second;  ///< position of the second child
    /// false: `connected` is known to both sides, and the edge belongs to another complex.
    bool code_connected = true;
    bool connected = false;
    const GridHint* grid = nullptr;  ///< of a split that is one of many alike
  };

  /// Codes and applies the split of `vertex` into itself and a new vertex, which is returned.
  /// `positions` is indexed by vertex and still holds the parent's position. The oracle (encoder
  /// only) answers what is true. The meters receive the costs.
  template <class Coder>
  uint32_t Code(Coder& coder, Complex& complex, const std::vector<Int3>& positions, uint32_t vertex,
                const Known& known, SplitOracle* oracle, SplitMeters* meters,
                uint64_t* exception_meter);

  /// Were the children of the split coded last connected.
  bool last_connected() const { return star_.connected; }
  /// How it parted the ring of a grid's vertex; 0: nothing like a grid's.
  uint8_t last_kind() const { return grid_kind_; }
  void Visit(LearnedStateVisitor& visitor);

 private:
  void Gather(const Complex& complex, uint32_t vertex);
  /// Which faces each neighbour is in; fans go without.
  void LinkFaces();
  void Measure(const std::vector<Int3>& positions, const Known& known);
  /// Returns whether the star is a fan that stays one; it is parted then, but for the new faces.
  template <class Coder>
  bool CodeFan(Coder& coder, const Complex& complex, const std::vector<Int3>& positions,
               const Known& known, SplitOracle* oracle, SplitMeters* meters);
  /// Of the fan and its spokes. second: the second child relative to the first.
  template <class Coder>
  FanCut CodeCut(Coder& coder, const Vector3& second, FanCut truth);
  void AddFanFaces(Complex& complex);
  void SortPivotCandidates();
  template <class Coder>
  void CodePivots(Coder& coder, SplitOracle* oracle, SplitMeters* meters);
  template <class Coder>
  void CodeSides(Coder& coder, SplitOracle* oracle, SplitMeters* meters);
  void SpreadSide(uint32_t start, Side side);
  /// How a face leans: the mean of its two corners beside the split vertex.
  int32_t LeanOfFace(const Complex& complex, const std::vector<Int3>& positions, const Known& known,
                     const SplitStar::StarFace& face) const;
  /// Of a face whose other corners are both connected to both children.
  template <class Coder>
  void CodeFreeFace(Coder& coder, const Complex& complex, int32_t lean, SplitOracle* oracle,
                    SplitStar::StarFace* face);
  template <class Coder>
  void CodeFaces(Coder& coder, const Complex& complex, const std::vector<Int3>& positions,
                 const Known& known, SplitOracle* oracle);
  template <class Coder>
  void CodeNewFaces(Coder& coder, SplitOracle* oracle, Complex& complex);
  void CountFace(const SplitStar::StarFace& face);
  void ApplySides(Complex& complex);

  template <class Visit>
  void ForEachLink(uint32_t neighbour, Visit visit) const {
    uint32_t link = star_.neighbours[neighbour].first_face;
    while (link != kNone) {
      const SplitStar::StarFace& face = star_.faces[link / 2];
      visit(link / 2, face.end[1 - link % 2]);
      link = face.next_link[link % 2];
    }
  }

  ConnectivitySettings settings_;
  SplitStar star_;
  Fan fan_;
  FanCut cut_;
  std::array<FanSpoke, Fan::kMostPlaces> spokes_;
  std::vector<uint32_t> last_split_;  ///< per vertex: number of vertices when it was split or made
  std::vector<uint32_t> slot_of_vertex_;  ///< index into star_.neighbours, valid where stamped
  std::vector<uint32_t> order_;
  std::vector<uint32_t> stack_;
  uint32_t pivots_ = 0;
  bool owns_child_edge_ = true;
  double children_distance_ = 0;
  double mean_distance_ = 0;

  std::unique_ptr<GridCuts> grid_cuts_;  ///< from the first fan of a grid on
  uint8_t grid_kind_ = 0;
  MixedModel<1> stays_fan_;
  // One of the two from the first fan on: most seams have none.
  std::unique_ptr<FanModel> fan_model_;
  std::unique_ptr<LightFanModel> light_fan_model_;
  MixedModel<2> connected_;
  MixedModel<3> pivot_;
  MixedModel<3> side_;
  MixedModel<2> face_both_;
  MixedModel<1> face_turn_;
  MixedModel<2> face_side_;
  MixedModel<2> new_face_;
  MixedModel<1> orientation_;
};

}  // namespace folprom
