#include "engine/hierarchy/quadric_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <queue>
#include <utility>
#include <vector>

#include "engine/geometry/local_frame.h"
#include "engine/hierarchy/grid_rounds.h"
#include "engine/hierarchy/merge_tree.h"
#include "engine/hierarchy/quadric.h"

namespace folprom {
namespace {

/// A vertex with more neighbours than this looks at the first of them only.
constexpr size_t kMostCandidates = 64;
/// Planes through open edges, perpendicular to the face, weigh this much more than the face.
constexpr double kBoundaryWeight = 4;
/// A contraction that turns a face over or pinches the surface waits until all others cost this
/// much more.
constexpr double kForbiddenFactor = 64;
/// Where so many of the vertices lie flat and so many on edges, lengths weigh so much less: edges
/// stay where they are.
constexpr double kFlatShare = 0.3, kSharpShare = 0.02, kSharpening = 100;
/// How far from a plane its points come to lie on the lattice, and twice the mean area of faces
/// whose angles that leaves alone.
constexpr double kRounding = 1, kLeastMeasured = 400;
/// Length of the sum of a vertex's face normals over their areas below which an edge goes through.
constexpr double kSharpNormals = 0.97;
/// Costs below this are equal: keys are floats, which round them to 0.
constexpr double kLeastKey = 1e-30;
/// Of regular grids so many times every second row or column goes first.
constexpr uint32_t kGridRounds = 6;

double SquaredLength(const Vector3& a) { return Dot(a, a); }

/// 10 bits a coordinate, interleaved.
uint32_t MortonCode(const Vector3& p, const Vector3& lo, double scale) {
  uint32_t code = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    auto value = static_cast<uint32_t>(std::min((p[axis] - lo[axis]) * scale, 1023.0));
    for (uint32_t bit = 0; bit < 10; ++bit) code |= (value >> bit & 1) << (3 * bit + axis);
  }
  return code;
}

class Contractor {
 public:
  Contractor(std::span<const Int3> positions, std::span<const Face> faces,
             std::span<const CrossFace> cross_faces, uint32_t subtree, double length_weight)
      : own_(static_cast<uint32_t>(positions.size())), length_weight_(length_weight), tree_(own_) {
    for (const Int3& p : positions) AddPoint(p);
    for (const Face& face : faces) faces_.push_back(face);
    for (const CrossFace& cross : cross_faces) {
      Face face;
      for (size_t i = 0; i < 3; ++i) {
        face[i] = cross.vertex[i].local;
        if (cross.vertex[i].subtree != subtree) face[i] = AddPoint(cross.position[i]);
      }
      faces_.push_back(face);
    }
    merged_into_.resize(points_.size());
    for (uint32_t i = 0; i < merged_into_.size(); ++i) merged_into_[i] = i;
    stamp_of_.assign(points_.size(), 0);
    quadrics_.resize(own_);
    stars_.resize(own_);
    forced_.assign(own_, 0);
    version_.assign(own_, 0);
    LinkStars();
    AddFacePlanes();
    if (HasFacesAndEdges()) length_weight_ = length_weight_ / kSharpening;
    AddBoundaryPlanes();
  }

  /// Before Build: contracts rows and columns of regular grids.
  void ThinGrids(const std::vector<std::vector<GridStep>>& rounds) {
    on_grid_ = !rounds.empty();
    for (const auto& round : rounds) {
      for (const GridStep& step : round) ThinGrid(step);
    }
  }

  SetTree Build(std::span<const Int3> positions) {
    building_ = true;
    for (uint32_t v = 0; v < own_; ++v) {
      if (merged_into_[v] == v) Enqueue(v);
    }
    while (!queue_.empty()) {
      Entry entry = queue_.top();
      queue_.pop();
      if (merged_into_[entry.vertex] != entry.vertex) continue;
      if (version_[entry.vertex] != entry.version) continue;
      Take(entry.vertex, entry.key);
    }
    JoinRemaining();
    SetTree tree = tree_.Flatten(positions);
    tree.SetOnGrid(on_grid_);
    return tree;
  }

 private:
  struct Entry {
    float key;
    uint32_t vertex;
    uint32_t version;
    bool operator<(const Entry& other) const {
      return key != other.key ? key > other.key : vertex > other.vertex;
    }
  };
  struct Candidate {
    double cost;
    uint32_t target;
  };

  uint32_t AddPoint(const Int3& p) {
    points_.push_back(
        {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
    return static_cast<uint32_t>(points_.size() - 1);
  }

  uint32_t Find(uint32_t v) {
    while (merged_into_[v] != v) {
      merged_into_[v] = merged_into_[merged_into_[v]];
      v = merged_into_[v];
    }
    return v;
  }

  void LinkStars() {
    for (uint32_t f = 0; f < faces_.size(); ++f) {
      for (size_t i = 0; i < 3; ++i) {
        uint32_t v = faces_[f][i];
        if (v >= own_) continue;
        if (v == faces_[f][(i + 1) % 3]) continue;  // a corner of this face twice
        stars_[v].push_back(f);
      }
    }
  }

  Vector3 Minus(uint32_t a, uint32_t b) const {
    const Vector3 &p = points_[a], &q = points_[b];
    return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
  }
  Vector3 AreaNormal(uint32_t a, uint32_t b, uint32_t c) const {
    return Cross(Minus(b, a), Minus(c, a));
  }

  void AddFacePlanes() {
    for (const Face& face : faces_) {
      Vector3 normal = AreaNormal(face[0], face[1], face[2]);
      double length = std::sqrt(SquaredLength(normal));
      if (!(length > 0)) continue;
      for (double& value : normal) value = value / length;
      double offset = -Dot(normal, points_[face[0]]);
      for (uint32_t v : face) {
        if (v < own_) quadrics_[v].AddPlane(normal, offset, length / 6);
      }
    }
  }

  /// Is this an object of flat faces that meet in edges, as machines and buildings are?
  bool HasFacesAndEdges() {
    uint32_t flat = 0, sharp = 0;
    for (uint32_t v = 0; v < own_; ++v) {
      const Bend bend = BendAt(v);
      flat += bend == Bend::kFlat ? 1 : 0;
      sharp += bend == Bend::kSharp ? 1 : 0;
    }

    return flat > kFlatShare * own_ && sharp > kSharpShare * own_;
  }
  /// Flat: all of the vertex's faces lie in one plane but for the rounding to the lattice.
  enum class Bend { kFlat, kSmooth, kSharp };
  Bend BendAt(uint32_t v) const {
    const std::vector<uint32_t>& star = stars_[v];
    Vector3 normal{0, 0, 0};
    double area = 0;
    for (uint32_t f : star) {
      const Vector3 face_normal = AreaNormal(faces_[f][0], faces_[f][1], faces_[f][2]);
      for (size_t i = 0; i < 3; ++i) normal[i] = normal[i] + face_normal[i];
      area = area + std::sqrt(SquaredLength(face_normal));
    }
    const double length = std::sqrt(SquaredLength(normal));
    if (star.empty() || area < kLeastMeasured * static_cast<double>(star.size()))
      return Bend::kSmooth;
    if (length < kSharpNormals * area) return Bend::kSharp;
    for (uint32_t f : star) {
      for (uint32_t corner : faces_[f]) {
        if (std::fabs(Dot(Minus(corner, v), normal)) > kRounding * length) return Bend::kSmooth;
      }
    }
    return Bend::kFlat;
  }

  void AddBoundaryPlanes() {
    struct Edge {
      uint32_t a, b, face;
    };
    std::vector<Edge> edges;
    for (uint32_t f = 0; f < faces_.size(); ++f) {
      for (size_t i = 0; i < 3; ++i) {
        uint32_t a = faces_[f][i], b = faces_[f][(i + 1) % 3];
        // Foreign ends have a number per face, so their edges would all seem open.
        if (a != b && a < own_ && b < own_) edges.push_back({std::min(a, b), std::max(a, b), f});
      }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& l, const Edge& r) {
      return l.a != r.a ? l.a < r.a : (l.b != r.b ? l.b < r.b : l.face < r.face);
    });
    for (size_t i = 0; i < edges.size(); ++i) {
      auto same = [&](size_t k) {
        return k < edges.size() && edges[k].a == edges[i].a && edges[k].b == edges[i].b;
      };
      if (same(i + 1) || (i > 0 && same(i - 1))) continue;
      const Face& face = faces_[edges[i].face];
      Vector3 along = Minus(edges[i].b, edges[i].a);
      Vector3 normal = Cross(AreaNormal(face[0], face[1], face[2]), along);
      double length = std::sqrt(SquaredLength(normal));
      if (!(length > 0)) continue;
      for (double& value : normal) value = value / length;
      double offset = -Dot(normal, points_[edges[i].a]);
      double weight = kBoundaryWeight * SquaredLength(along) / 6;
      quadrics_[edges[i].a].AddPlane(normal, offset, weight);
      quadrics_[edges[i].b].AddPlane(normal, offset, weight);
    }
  }

  /// The distinct neighbours of v go to ring_. Faces that have collapsed to an edge stay in the
  /// star only while no other face of it joins v to the same neighbour.
  void CollectRing(uint32_t v) {
    std::vector<uint32_t>& star = stars_[v];
    ring_.clear();
    collapsed_.clear();
    ++stamp_;
    size_t kept = 0;
    for (uint32_t f : star) {
      for (uint32_t& corner : faces_[f]) corner = Find(corner);
      const auto [a, b, c] = faces_[f];
      if (a == b || b == c || a == c) {
        if (a != b || b != c) collapsed_.push_back(f);
        continue;
      }
      star[kept++] = f;
      for (uint32_t w : {a, b, c}) AddToRing(v, w);
    }
    for (uint32_t f : collapsed_) {
      bool needed = false;
      for (uint32_t corner : faces_[f]) needed = AddToRing(v, Find(corner)) || needed;
      if (needed) star[kept++] = f;
    }
    star.resize(kept);
  }
  bool AddToRing(uint32_t v, uint32_t w) {
    if (w == v || w >= own_ || stamp_of_[w] == stamp_) return false;
    stamp_of_[w] = stamp_;
    ring_.push_back(w);
    return true;
  }

  double CostOf(uint32_t v, uint32_t target) const {
    const Quadric& own = quadrics_[v];
    double error = own.At(points_[target]) + quadrics_[target].At(points_[target]);
    return error + length_weight_ * own.weight * SquaredLength(Minus(v, target));
  }

  void CollectCandidates(uint32_t v) {
    CollectRing(v);
    candidates_.clear();
    for (uint32_t target : ring_) {
      if (candidates_.size() == kMostCandidates) break;
      candidates_.push_back({CostOf(v, target), target});
    }
  }

  void Enqueue(uint32_t v) {
    CollectCandidates(v);
    if (candidates_.empty()) return;
    double least = candidates_[0].cost;
    for (const Candidate& candidate : candidates_) least = std::min(least, candidate.cost);
    Push(v, least);
  }
  void Push(uint32_t v, double key) { queue_.push({static_cast<float>(key), v, ++version_[v]}); }

  /// Contracts v into its best neighbour, or puts it back with a higher key.
  void Take(uint32_t v, float key) {
    CollectCandidates(v);
    if (candidates_.empty()) return;
    std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
      return a.cost != b.cost ? a.cost < b.cost : a.target < b.target;
    });
    constexpr double kSlack = 1.0001;
    double limit = static_cast<double>(key) * kSlack;
    if (forced_[v] != 0) limit = limit / kForbiddenFactor;
    limit = std::max(limit, kLeastKey);
    if (candidates_[0].cost > limit) {
      forced_[v] = 0;
      Push(v, candidates_[0].cost);
      return;
    }
    if (forced_[v] != 0) {
      Contract(v, candidates_[0]);
      return;
    }
    // A second and a third choice cost more: they wait for their turn.
    for (const Candidate& candidate : candidates_) {
      if (!IsAllowed(v, candidate.target)) continue;
      if (candidate.cost <= 2 * limit) {
        Contract(v, candidate);
      } else {
        Push(v, candidate.cost);
      }
      return;
    }
    forced_[v] = 1;
    Push(v, std::max(candidates_[0].cost, 1e-20) * kForbiddenFactor);
  }

  /// Into a neighbour on the grid; where there is none, or it may not be, v stays.
  void ThinGrid(const GridStep& step) {
    const uint32_t v = step.vertex;
    if (merged_into_[v] != v) return;
    CollectCandidates(v);
    for (uint32_t target : step.targets) {
      for (const Candidate& candidate : candidates_) {
        if (candidate.target != target || !IsAllowed(v, target)) continue;
        Contract(v, candidate);
        return;
      }
    }
  }

  bool IsAllowed(uint32_t v, uint32_t target) {
    uint32_t shared = 0;
    for (uint32_t f : stars_[v]) {
      Face face{Find(faces_[f][0]), Find(faces_[f][1]), Find(faces_[f][2])};
      if (face[0] == face[1] || face[1] == face[2] || face[0] == face[2]) continue;
      if (face[0] == target || face[1] == target || face[2] == target) {
        ++shared;
        continue;
      }
      Vector3 before = AreaNormal(face[0], face[1], face[2]);
      for (uint32_t& corner : face) {
        if (corner == v) corner = target;
      }
      Vector3 after = AreaNormal(face[0], face[1], face[2]);
      double agreement = Dot(before, after);
      double limit = 0.04 * SquaredLength(before) * SquaredLength(after);
      if (agreement < 0 || agreement * agreement < limit) return false;
    }
    // The link condition: common neighbours lie on faces of the edge.
    return CommonNeighbours(target) <= shared;
  }

  /// How many vertices of ring_ are neighbours of target; looks through whichever stars are
  /// smaller, since a hub's is looked at once for each of its spokes.
  uint32_t CommonNeighbours(uint32_t target) {
    uint32_t common = 0;
    size_t around = 0;
    for (uint32_t w : ring_) around += w != target ? stars_[w].size() : 0;
    if (around < stars_[target].size()) {
      for (uint32_t w : ring_) common += w != target && AreNeighbours(w, target) ? 1 : 0;
      return common;
    }
    ++stamp_;
    for (uint32_t w : ring_) stamp_of_[w] = stamp_;
    uint32_t second = stamp_ + 1;
    for (uint32_t f : stars_[target]) {
      for (uint32_t corner : faces_[f]) {
        uint32_t w = Find(corner);
        if (w >= own_ || stamp_of_[w] != stamp_) continue;
        stamp_of_[w] = second;
        if (w != target) ++common;
      }
    }
    ++stamp_;
    return common;
  }
  bool AreNeighbours(uint32_t v, uint32_t other) {
    for (uint32_t f : stars_[v]) {
      for (uint32_t corner : faces_[f]) {
        if (Find(corner) == other) return true;
      }
    }
    return false;
  }

  void Contract(uint32_t v, const Candidate& candidate) {
    uint32_t target = candidate.target;
    const Quadric& own = quadrics_[v];
    double squared = own.weight > 0 ? own.At(points_[target]) / own.weight : 0;
    merged_into_[v] = target;
    quadrics_[target].Add(own);
    std::vector<uint32_t>& star = stars_[v];
    std::vector<uint32_t>& grown = stars_[target];
    if (grown.size() < star.size()) grown.swap(star);
    grown.insert(grown.end(), star.begin(), star.end());
    star = {};
    const bool was_forced = forced_[target] != 0;
    forced_[target] = 0;
    tree_.Join(target, v, std::sqrt(squared), own.weight);
    // Costs only grow, so the target's old key still says when to look at it again.
    if (building_ && was_forced && grown.size() <= 4 * kMostCandidates) Enqueue(target);
  }

  /// Vertices that no edge joins any more: neighbours on the Morton curve, pair by pair.
  void JoinRemaining() {
    std::vector<uint32_t> live;
    for (uint32_t v = 0; v < own_; ++v) {
      if (merged_into_[v] == v) live.push_back(v);
    }
    Vector3 lo = points_[0], hi = points_[0];
    for (const Vector3& p : points_) {
      for (size_t i = 0; i < 3; ++i) {
        lo[i] = std::min(lo[i], p[i]);
        hi[i] = std::max(hi[i], p[i]);
      }
    }
    double side = std::max({hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2], 1.0});
    std::vector<uint32_t> code(own_, 0);
    for (uint32_t v : live) code[v] = MortonCode(points_[v], lo, 1023 / side);
    std::stable_sort(live.begin(), live.end(),
                     [&](uint32_t a, uint32_t b) { return code[a] < code[b]; });
    while (live.size() > 1) {
      std::vector<uint32_t> next;
      for (size_t i = 0; i < live.size(); i += 2) {
        uint32_t kept = live[i];
        if (i + 1 < live.size()) {
          uint32_t removed = live[i + 1];
          if (quadrics_[removed].weight > quadrics_[kept].weight) std::swap(kept, removed);
          double area = quadrics_[removed].weight;
          quadrics_[kept].Add(quadrics_[removed]);
          tree_.Join(kept, removed, std::sqrt(SquaredLength(Minus(kept, removed))), area);
        }
        next.push_back(kept);
      }
      live = std::move(next);
    }
  }

  uint32_t own_;
  double length_weight_;
  std::vector<Vector3> points_;  ///< own vertices, then a point per foreign corner
  std::vector<Face> faces_;
  std::vector<std::vector<uint32_t>> stars_;
  std::vector<uint32_t> merged_into_;
  std::vector<Quadric> quadrics_;
  std::vector<uint8_t> forced_;
  std::vector<uint32_t> version_;
  std::priority_queue<Entry> queue_;
  std::vector<uint32_t> ring_, collapsed_;
  std::vector<Candidate> candidates_;
  std::vector<uint32_t> stamp_of_;
  uint32_t stamp_ = 0;
  bool on_grid_ = false, building_ = false;
  MergeTree tree_;
};

}  // namespace

SetTree BuildQuadricTree(std::span<const Int3> positions, std::span<const Face> faces,
                         std::span<const CrossFace> cross_faces, uint32_t subtree,
                         const CodecSettings& settings) {
  Contractor contractor(positions, faces, cross_faces, subtree, settings.length_weight);
  contractor.ThinGrids(PlanGridRounds(positions, faces, kGridRounds));
  return contractor.Build(positions);
}

}  // namespace folprom
