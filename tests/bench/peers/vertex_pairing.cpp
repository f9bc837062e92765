#include "tests/bench/peers/vertex_pairing.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>

namespace folprom::peers {
namespace {

bool Near(const Point& a, const Point& b, double tolerance) {
  return std::fabs(a[0] - b[0]) <= tolerance && std::fabs(a[1] - b[1]) <= tolerance &&
         std::fabs(a[2] - b[2]) <= tolerance;
}

// Finds points by cubes twice the tolerance wide.
class PointIndex {
 public:
  PointIndex(const std::vector<Point>& points, double tolerance)
      : points_(points), tolerance_(tolerance) {
    order_.reserve(points.size());
    for (uint32_t v = 0; v < points.size(); ++v) order_.push_back({CellOf(points[v]), v});
    std::sort(order_.begin(), order_.end());
  }

  std::vector<uint32_t> NearTo(const Point& p) const {
    std::vector<uint32_t> found;
    Point corner;
    for (int k = 0; k < 8; ++k) {
      for (size_t axis = 0; axis < 3; ++axis) {
        corner[axis] = p[axis] + (k >> axis & 1 ? tolerance_ : -tolerance_);
      }
      const Cell cell = CellOf(corner);
      auto at = std::lower_bound(order_.begin(), order_.end(), Entry{cell, 0});
      for (; at != order_.end() && at->cell == cell; ++at) {
        if (Near(points_[at->vertex], p, tolerance_)) found.push_back(at->vertex);
      }
    }
    // Corners may share a cube.
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

 private:
  using Cell = std::array<double, 3>;
  struct Entry {
    Cell cell;
    uint32_t vertex;
    auto operator<=>(const Entry&) const = default;
  };

  Cell CellOf(const Point& p) const {
    const double side = 2 * tolerance_;
    return {std::floor(p[0] / side), std::floor(p[1] / side), std::floor(p[2] / side)};
  }

  const std::vector<Point>& points_;
  const double tolerance_;
  std::vector<Entry> order_;
};

// The faces around each vertex.
class FaceIndex {
 public:
  explicit FaceIndex(const Mesh& mesh) : begin_(mesh.positions.size() + 1) {
    for (const Triple& face : mesh.faces) {
      for (const uint32_t v : face) ++begin_[v + 1];
    }
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    faces_.resize(begin_.back());
    std::vector<uint64_t> next = begin_;
    for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
      for (const uint32_t v : mesh.faces[f]) faces_[next[v]++] = f;
    }
  }
  std::span<const uint32_t> Around(uint32_t vertex) const {
    return {faces_.data() + begin_[vertex], faces_.data() + begin_[vertex + 1]};
  }

 private:
  std::vector<uint64_t> begin_;
  std::vector<uint32_t> faces_;
};

class Pairing {
 public:
  Pairing(const Mesh& original, const Mesh& decoded, double tolerance)
      : original_(original),
        decoded_(decoded),
        original_faces_(original),
        decoded_faces_(decoded),
        candidates_(decoded.positions.size()),
        partner_(decoded.positions.size(), kNoVertex),
        taken_(original.positions.size(), false),
        queued_(decoded.positions.size(), false) {
    const PointIndex index(original.positions, tolerance);
    for (uint32_t v = 0; v < candidates_.size(); ++v) {
      candidates_[v] = index.NearTo(decoded.positions[v]);
      if (candidates_[v].size() < 2) continue;
      left_.push_back(v);
      for (const uint32_t choice : candidates_[v]) claims_.push_back({choice, v});
    }
    std::sort(claims_.begin(), claims_.end());
  }

  std::vector<uint32_t> Run() {
    for (uint32_t v = 0; v < partner_.size(); ++v) {
      if (candidates_[v].size() == 1) Pair(v, candidates_[v].front());
    }
    for (const uint32_t v : left_) Enqueue(v);
    do {
      while (!queue_.empty()) NarrowNext();
    } while (Guess());
    return std::move(partner_);
  }

 private:
  bool Paired(uint32_t v) const { return partner_[v] != kNoVertex; }

  void Enqueue(uint32_t v) {
    if (Paired(v) || queued_[v] || candidates_[v].size() < 2) return;
    queued_[v] = true;
    queue_.push_back(v);
  }

  void EnqueueNeighbours(uint32_t v) {
    for (const uint32_t f : decoded_faces_.Around(v)) {
      for (const uint32_t w : decoded_.faces[f]) Enqueue(w);
    }
  }

  void Pair(uint32_t v, uint32_t choice) {
    if (taken_[choice]) return;
    taken_[choice] = true;
    partner_[v] = choice;
    EnqueueNeighbours(v);
    auto claim = std::lower_bound(claims_.begin(), claims_.end(), Claim{choice, 0});
    for (; claim != claims_.end() && claim->original == choice; ++claim) Enqueue(claim->decoded);
  }

  // Leaves those candidates that are free and could bring back all faces of the vertex. Where none
  // could, the mesh is not the original here, and faces say nothing.
  void NarrowNext() {
    const uint32_t v = queue_.back();
    queue_.pop_back();
    queued_[v] = false;
    if (Paired(v)) return;
    std::vector<uint32_t>& choices = candidates_[v];
    const size_t before = choices.size();
    std::erase_if(choices, [&](uint32_t choice) { return taken_[choice]; });
    std::vector<uint32_t> able;
    std::copy_if(choices.begin(), choices.end(), std::back_inserter(able), [&](uint32_t choice) {
      const size_t faces = decoded_faces_.Around(v).size();
      return original_faces_.Around(choice).size() == faces && FacesBack(v, choice) == faces;
    });
    if (!able.empty()) choices = std::move(able);
    if (choices.size() == 1) {
      Pair(v, choices.front());
    } else if (choices.size() < before) {
      EnqueueNeighbours(v);
    }
  }

  // Number of the faces of v that some face around `choice` could be.
  size_t FacesBack(uint32_t v, uint32_t choice) const {
    const auto decoded = decoded_faces_.Around(v);
    return static_cast<size_t>(std::count_if(decoded.begin(), decoded.end(), [&](uint32_t f) {
      const auto faces = original_faces_.Around(choice);
      return std::any_of(faces.begin(), faces.end(), [&](uint32_t g) {
        return CouldBe(v, choice, decoded_.faces[f], original_.faces[g]);
      });
    }));
  }

  // Could the two faces be the same in one of their rotations, if v were `choice`.
  bool CouldBe(uint32_t v, uint32_t choice, const Triple& decoded, const Triple& original) const {
    const auto could = [&](uint32_t w, uint32_t o) {
      if (w == v || o == choice) return w == v && o == choice;
      if (Paired(w)) return partner_[w] == o;
      return !taken_[o] &&
             std::find(candidates_[w].begin(), candidates_[w].end(), o) != candidates_[w].end();
    };
    for (size_t k = 0; k < 3; ++k) {
      if (could(decoded[0], original[k]) && could(decoded[1], original[(k + 1) % 3]) &&
          could(decoded[2], original[(k + 2) % 3])) {
        return true;
      }
    }
    return false;
  }

  // One of those left takes the candidate that brings back most faces; any where they are alike.
  bool Guess() {
    std::erase_if(left_, [&](uint32_t v) { return Paired(v) || candidates_[v].empty(); });
    if (left_.empty()) return false;
    const uint32_t v = left_.back();
    left_.pop_back();
    std::vector<uint32_t>& choices = candidates_[v];
    std::erase_if(choices, [&](uint32_t choice) { return taken_[choice]; });
    if (choices.empty()) return true;
    const auto best = std::max_element(choices.begin(), choices.end(), [&](uint32_t a, uint32_t b) {
      return FacesBack(v, a) < FacesBack(v, b);
    });
    Pair(v, *best);
    return true;
  }

  struct Claim {
    uint32_t original;
    uint32_t decoded;
    auto operator<=>(const Claim&) const = default;
  };

  const Mesh& original_;
  const Mesh& decoded_;
  const FaceIndex original_faces_, decoded_faces_;
  std::vector<std::vector<uint32_t>> candidates_;  ///< original vertices near a decoded one
  std::vector<Claim> claims_;                      ///< of those with more than one candidate
  std::vector<uint32_t> partner_;
  std::vector<bool> taken_;
  std::vector<uint32_t> queue_;  ///< to be narrowed
  std::vector<bool> queued_;
  std::vector<uint32_t> left_;  ///< had more than one candidate, not paired when last looked
};

}  // namespace

bool InSameOrder(const Mesh& original, const Mesh& decoded, double tolerance) {
  return std::equal(original.positions.begin(), original.positions.end(), decoded.positions.begin(),
                    decoded.positions.end(),
                    [&](const Point& a, const Point& b) { return Near(a, b, tolerance); });
}

std::vector<uint32_t> PairVertices(const Mesh& original, const Mesh& decoded, double tolerance) {
  if (InSameOrder(original, decoded, tolerance)) {
    std::vector<uint32_t> identity(original.positions.size());
    std::iota(identity.begin(), identity.end(), 0U);
    return identity;
  }
  return Pairing(original, decoded, tolerance).Run();
}

}  // namespace folprom::peers
