#include "engine/hierarchy/quadric_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/hierarchy/contraction_mesh.h"
#include "engine/hierarchy/cost_queue.h"
#include "engine/hierarchy/grid_rounds.h"
#include "engine/hierarchy/merge_tree.h"

namespace folprom {
namespace {

/// A vertex with more neighbours than this looks at the first of them only.
constexpr size_t kMostCandidates = 64;
/// A contraction that turns a face over or pinches the surface waits until all others cost this
/// much more.
constexpr float kForbiddenFactor = 64;
/// Of objects of flat faces lengths weigh so much less: edges stay where they are.
constexpr double kSharpening = 150;
constexpr float kLeastCost = 1e-20F;
/// Of regular grids so many times every second row or column goes first.
constexpr uint32_t kGridRounds = 6;

/// 10 bits a coordinate, interleaved.
uint32_t MortonCode(const Int3& p, const Int3& lo, double scale) {
  uint32_t code = 0;
  for (uint32_t axis = 0; axis < 3; ++axis) {
    const double offset = static_cast<double>(At(p, axis)) - At(lo, axis);
    auto value = static_cast<uint32_t>(std::min(offset * scale, 1023.0));
    for (uint32_t bit = 0; bit < 10; ++bit) code |= (value >> bit & 1) << (3 * bit + axis);
  }
  return code;
}

class Contractor {
 public:
  Contractor(std::span<const Int3> positions, std::span<const Face> faces,
             std::span<const CrossFace> cross_faces, uint32_t subtree, double length_weight)
      : positions_(positions),
        mesh_(positions, faces, cross_faces, subtree),
        queue_(mesh_.vertices()),
        forced_(mesh_.vertices(), 0),
        tree_(mesh_.vertices()) {
    if (mesh_.HasFacesAndEdges()) length_weight = length_weight / kSharpening;
    length_weight_ = static_cast<float>(length_weight);
  }

  /// Before Build: contracts rows and columns of regular grids.
  void ThinGrids(const std::vector<std::vector<GridStep>>& rounds) {
    on_grid_ = !rounds.empty();
    for (const auto& round : rounds) {
      for (const GridStep& step : round) ThinGrid(step);
    }
  }

  SetTree Build() {
    // Of equals the one that came last is taken first.
    for (uint32_t v = mesh_.vertices(); v-- > 0;) {
      if (mesh_.IsLive(v)) Enqueue(v);
    }
    for (uint32_t v = queue_.Take(); v != CostQueue::kNobody; v = queue_.Take()) {
      Prefetch(queue_.Peek());
      Consider(v);
    }
    JoinRemaining();
    SetTree tree = tree_.Flatten(positions_);
    tree.SetOnGrid(on_grid_);
    return tree;
  }

 private:
  struct Candidate {
    float cost;
    uint32_t target;
    bool operator<(const Candidate& other) const {
      return cost != other.cost ? cost < other.cost : target < other.target;
    }
  };

  /// False: v has no neighbour.
  bool CollectCandidates(uint32_t v) {
    candidates_.clear();
    for (uint32_t target : mesh_.CollectRing(v)) {
      if (candidates_.size() == kMostCandidates) break;
      candidates_.push_back({mesh_.CostOf(v, target, length_weight_), target});
    }
    return !candidates_.empty();
  }

  void Enqueue(uint32_t v) {
    if (!CollectCandidates(v)) return;
    queue_.Push(v, std::min_element(candidates_.begin(), candidates_.end())->cost);
  }

  /// Each step reads what the one before it has asked for some turns ago.
  void Prefetch(uint32_t v) {
    if (v == CostQueue::kNobody) return;
    const auto before = [&](uint32_t turns) { return ahead_[(turn_ - turns) % kTurns]; };
    ahead_[++turn_ % kTurns] = v;
    mesh_.PrefetchVertex(v);
    mesh_.PrefetchStar(before(1));
    mesh_.PrefetchFaces(before(3));
    mesh_.PrefetchCorners(before(5));
  }

  bool MayContract(uint32_t v, uint32_t target) {
    return mesh_.IsAllowed(v, target) && !mesh_.PinchesRims(v, target);
  }

  /// Contracts v into its best neighbour, or puts it back with a higher cost.
  void Consider(uint32_t v) {
    if (!CollectCandidates(v)) return;
    const auto best = std::min_element(candidates_.begin(), candidates_.end());
    const float limit = forced_[v] != 0 ? queue_.Limit() / kForbiddenFactor : queue_.Limit();
    if (best->cost > std::max(limit, kLeastCost)) {
      forced_[v] = 0;
      queue_.Push(v, best->cost);
      return;
    }
    if (forced_[v] != 0 || MayContract(v, best->target)) {
      Contract(v, *best);
      return;
    }
    // A second and a third choice cost more: they wait for their turn.
    std::sort(candidates_.begin(), candidates_.end());
    for (size_t i = 1; i < candidates_.size(); ++i) {
      const Candidate& candidate = candidates_[i];
      if (!MayContract(v, candidate.target)) continue;
      if (candidate.cost <= 2 * limit) {
        Contract(v, candidate);
      } else {
        queue_.Push(v, candidate.cost);
      }
      return;
    }
    forced_[v] = 1;
    queue_.Push(v, std::max(candidates_[0].cost, kLeastCost) * kForbiddenFactor);
  }

  /// Into a neighbour on the grid; where there is none, or it may not be, v stays. Rims may meet
  /// there: a row or column that goes as a whole is worth more.
  void ThinGrid(const GridStep& step) {
    const uint32_t v = step.vertex;
    if (!mesh_.IsLive(v) || !CollectCandidates(v)) return;
    for (uint32_t target : step.targets) {
      for (const Candidate& candidate : candidates_) {
        if (candidate.target != target || !mesh_.IsAllowed(v, target)) continue;
        Contract(v, candidate);
        return;
      }
    }
  }

  void Contract(uint32_t v, const Candidate& candidate) {
    const uint32_t target = candidate.target;
    const double area = mesh_.AreaOf(v);
    tree_.Join(target, v, mesh_.Contract(v, target), area);
    // Costs only grow, so the target's place in the queue still says when to look at it again.
    if (forced_[target] == 0) return;
    forced_[target] = 0;
    if (mesh_.StarSize(target) <= 4 * kMostCandidates) Enqueue(target);
  }

  /// Vertices that no edge joins any more: neighbours on the Morton curve, pair by pair.
  void JoinRemaining() {
    struct Left {
      uint32_t vertex, code;
      double area;
    };
    Int3 lo = positions_[0], hi = positions_[0];
    for (const Int3& p : positions_) {
      for (uint32_t i = 0; i < 3; ++i) {
        At(lo, i) = std::min(At(lo, i), At(p, i));
        At(hi, i) = std::max(At(hi, i), At(p, i));
      }
    }
    const Vector3 size = Difference(hi, lo);
    const double scale = 1023 / std::max({size[0], size[1], size[2], 1.0});
    std::vector<Left> left, next;
    for (uint32_t v = 0; v < mesh_.vertices(); ++v) {
      if (mesh_.IsLive(v)) {
        left.push_back({v, MortonCode(positions_[v], lo, scale), mesh_.AreaOf(v)});
      }
    }
    std::stable_sort(left.begin(), left.end(),
                     [](const Left& a, const Left& b) { return a.code < b.code; });
    while (left.size() > 1) {
      next.clear();
      for (size_t i = 0; i < left.size(); i += 2) {
        Left kept = left[i];
        if (i + 1 < left.size()) {
          Left removed = left[i + 1];
          if (removed.area > kept.area) std::swap(kept, removed);
          tree_.Join(kept.vertex, removed.vertex, mesh_.Distance(kept.vertex, removed.vertex),
                     removed.area);
          kept.area += removed.area;
        }
        next.push_back(kept);
      }
      left.swap(next);
    }
  }

  std::span<const Int3> positions_;
  ContractionMesh mesh_;
  CostQueue queue_;
  float length_weight_ = 0;
  std::vector<uint8_t> forced_;
  std::vector<Candidate> candidates_;
  static constexpr uint32_t kTurns = 8;
  std::array<uint32_t, kTurns> ahead_{};  ///< vertices that will be considered
  uint32_t turn_ = kTurns;
  bool on_grid_ = false;
  MergeTree tree_;
};

}  // namespace

SetTree BuildQuadricTree(std::span<const Int3> positions, std::span<const Face> faces,
                         std::span<const CrossFace> cross_faces, uint32_t subtree,
                         const CodecSettings& settings) {
  Contractor contractor(positions, faces, cross_faces, subtree, settings.length_weight);
  contractor.ThinGrids(PlanGridRounds(positions, faces, kGridRounds));
  return contractor.Build();
}

}  // namespace folprom
