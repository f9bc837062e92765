#include "tests/bench/peers/vertex_pairing.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

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
        taken_(original.positions.size(), false) {
    const PointIndex index(original.positions, tolerance);
    for (size_t v = 0; v < candidates_.size(); ++v) {
      candidates_[v] = index.NearTo(decoded.positions[v]);
    }
  }

  std::vector<uint32_t> Run() {
    for (uint32_t v = 0; v < partner_.size(); ++v) {
      if (candidates_[v].size() == 1) Pair(v, candidates_[v].front());
    }
    left_.resize(partner_.size());
    std::iota(left_.begin(), left_.end(), 0U);
    do {
      Spread();
    } while (PairLastChoices() || PairBestGuess());
    return std::move(partner_);
  }

 private:
  bool Paired(uint32_t v) const { return partner_[v] != kNoVertex; }

  void Pair(uint32_t v, uint32_t original) {
    if (taken_[original]) return;
    taken_[original] = true;
    partner_[v] = original;
    fresh_.push_back(v);
  }

  // From paired vertices to their neighbours, as far as faces leave one choice.
  void Spread() {
    while (!fresh_.empty()) {
      const uint32_t v = fresh_.back();
      fresh_.pop_back();
      for (const uint32_t f : decoded_faces_.Around(v)) {
        for (const uint32_t w : decoded_.faces[f]) {
          if (!Paired(w)) PairByFace(decoded_.faces[f], w);
        }
      }
    }
  }

  // Where a face has two paired corners, the third is that of an original face on the same edge.
  void PairByFace(const Triple& face, uint32_t w) {
    const size_t corner =
        static_cast<size_t>(std::find(face.begin(), face.end(), w) - face.begin());
    const uint32_t next = partner_[face[(corner + 1) % 3]];
    const uint32_t last = partner_[face[(corner + 2) % 3]];
    if (next == kNoVertex || last == kNoVertex) return;
    uint32_t only = kNoVertex;
    for (const uint32_t choice : candidates_[w]) {
      if (taken_[choice] || choice == only || !HasFace({choice, next, last})) continue;
      if (only != kNoVertex) return;
      only = choice;
    }
    if (only != kNoVertex) Pair(w, only);
  }

  bool HasFace(const Triple& wanted) const {
    for (const uint32_t f : original_faces_.Around(wanted[0])) {
      const Triple& face = original_.faces[f];
      for (size_t k = 0; k < 3; ++k) {
        if (Triple{face[k], face[(k + 1) % 3], face[(k + 2) % 3]} == wanted) return true;
      }
    }
    return false;
  }

  void DropTaken(uint32_t v) {
    std::erase_if(candidates_[v], [&](uint32_t choice) { return taken_[choice]; });
  }

  bool PairLastChoices() {
    std::erase_if(left_, [&](uint32_t v) { return Paired(v); });
    for (const uint32_t v : left_) {
      DropTaken(v);
      if (candidates_[v].size() == 1) Pair(v, candidates_[v].front());
    }
    return !fresh_.empty();
  }

  // One of those left goes to the candidate with the most faces in common; all are in a tie where
  // its neighbours are left too.
  bool PairBestGuess() {
    for (const uint32_t v : left_) {
      const std::vector<uint32_t>& choices = candidates_[v];
      if (choices.empty()) continue;
      Pair(v, *std::max_element(choices.begin(), choices.end(), [&](uint32_t a, uint32_t b) {
             return Agreement(v, a) < Agreement(v, b);
           }));
      return true;
    }
    return false;
  }

  // Faces of v that this choice would bring back; -1 where it has another number of faces.
  int Agreement(uint32_t v, uint32_t choice) const {
    if (decoded_faces_.Around(v).size() != original_faces_.Around(choice).size()) return -1;
    int agreement = 0;
    for (const uint32_t f : decoded_faces_.Around(v)) {
      Triple mapped;
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t corner = decoded_.faces[f][k];
        mapped[k] = corner == v ? choice : partner_[corner];
      }
      std::rotate(mapped.begin(), std::find(mapped.begin(), mapped.end(), choice), mapped.end());
      agreement += HasFace(mapped) ? 1 : 0;
    }
    return agreement;
  }

  const Mesh& original_;
  const Mesh& decoded_;
  const FaceIndex original_faces_, decoded_faces_;
  std::vector<std::vector<uint32_t>> candidates_;  ///< original vertices near a decoded one
  std::vector<uint32_t> partner_;
  std::vector<bool> taken_;
  std::vector<uint32_t> fresh_;  ///< paired, neighbours not looked at
  std::vector<uint32_t> left_;   ///< decoded vertices that were not paired when last looked
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
