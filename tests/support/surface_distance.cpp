#include "tests/support/surface_distance.h"

#include <algorithm>
#include <cmath>

namespace folprom::support {
namespace {

Point Minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double Dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point Along(const Point& p, double t, const Point& d) {
  return {p[0] + t * d[0], p[1] + t * d[1], p[2] + t * d[2]};
}

/// Nearest point of a triangle (Ericson, Real-Time Collision Detection, 5.1.5).
Point NearestOf(const Point& a, const Point& b, const Point& c, const Point& p) {
  Point ab = Minus(b, a), ac = Minus(c, a), ap = Minus(p, a);
  double d1 = Dot(ab, ap), d2 = Dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return a;
  Point bp = Minus(p, b);
  double d3 = Dot(ab, bp), d4 = Dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return b;
  double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return Along(a, d1 / (d1 - d3), ab);
  Point cp = Minus(p, c);
  double d5 = Dot(ab, cp), d6 = Dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return c;
  double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return Along(a, d2 / (d2 - d6), ac);
  double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    return Along(b, (d4 - d3) / ((d4 - d3) + (d5 - d6)), Minus(c, b));
  }
  double sum = va + vb + vc;
  return Along(Along(a, vb / sum, ab), vc / sum, ac);
}

}  // namespace

SurfaceDistance::SurfaceDistance(const Mesh& mesh) : mesh_(mesh), elements_(mesh.faces) {
  for (uint64_t v = 0; v < mesh.positions.size(); ++v) elements_.push_back({v, v, v});
  Point lo = mesh.positions[0], hi = lo;
  for (const Point& p : mesh.positions) {
    for (size_t i = 0; i < 3; ++i) {
      lo[i] = std::min(lo[i], p[i]);
      hi[i] = std::max(hi[i], p[i]);
    }
  }
  double longest = std::max({hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]});
  double wanted = std::clamp(std::sqrt(static_cast<double>(elements_.size()) / 2), 1.0, 160.0);
  origin_ = lo;
  if (longest > 0) cell_ = longest / wanted;
  for (size_t i = 0; i < 3; ++i) {
    size_[i] = static_cast<int64_t>((hi[i] - lo[i]) / cell_) + 1;
  }
  begin_.assign(static_cast<size_t>(size_[0] * size_[1] * size_[2]) + 1, 0);
  for (const Triple& element : elements_) {
    ForEachCellOf(element, [&](size_t index) { ++begin_[index + 1]; });
  }
  for (size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  items_.resize(begin_.back());
  std::vector<uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (uint32_t e = 0; e < elements_.size(); ++e) {
    ForEachCellOf(elements_[e], [&](size_t index) { items_[next[index]++] = e; });
  }
}

SurfaceDistance::Cell SurfaceDistance::CellOf(const Point& point) const {
  Cell cell;
  for (size_t i = 0; i < 3; ++i) {
    double step = std::floor((point[i] - origin_[i]) / cell_);
    cell[i] = static_cast<int64_t>(std::clamp(step, 0.0, static_cast<double>(size_[i] - 1)));
  }
  return cell;
}

size_t SurfaceDistance::IndexOf(const Cell& cell) const {
  return static_cast<size_t>((cell[2] * size_[1] + cell[1]) * size_[0] + cell[0]);
}

template <class Visit>
void SurfaceDistance::ForEachCellOf(const Triple& element, Visit visit) const {
  Cell lo = CellOf(mesh_.positions[element[0]]), hi = lo;
  for (uint64_t vertex : element) {
    Cell cell = CellOf(mesh_.positions[vertex]);
    for (size_t i = 0; i < 3; ++i) {
      lo[i] = std::min(lo[i], cell[i]);
      hi[i] = std::max(hi[i], cell[i]);
    }
  }
  for (int64_t z = lo[2]; z <= hi[2]; ++z) {
    for (int64_t y = lo[1]; y <= hi[1]; ++y) {
      for (int64_t x = lo[0]; x <= hi[0]; ++x) visit(IndexOf({x, y, z}));
    }
  }
}

void SurfaceDistance::SearchRing(const Cell& centre, int64_t ring, const Point& point,
                                 double* nearest2) const {
  Cell lo, hi;
  for (size_t i = 0; i < 3; ++i) {
    lo[i] = std::max<int64_t>(centre[i] - ring, 0);
    hi[i] = std::min<int64_t>(centre[i] + ring, size_[i] - 1);
  }
  for (int64_t z = lo[2]; z <= hi[2]; ++z) {
    for (int64_t y = lo[1]; y <= hi[1]; ++y) {
      bool on_side = std::abs(z - centre[2]) == ring || std::abs(y - centre[1]) == ring;
      for (int64_t x = lo[0]; x <= hi[0]; ++x) {
        if (!on_side && std::abs(x - centre[0]) != ring) continue;
        size_t index = IndexOf({x, y, z});
        for (uint32_t i = begin_[index]; i < begin_[index + 1]; ++i) {
          const Triple& e = elements_[items_[i]];
          Point d = Minus(point, NearestOf(mesh_.positions[e[0]], mesh_.positions[e[1]],
                                           mesh_.positions[e[2]], point));
          *nearest2 = std::min(*nearest2, Dot(d, d));
        }
      }
    }
  }
}

double SurfaceDistance::To(const Point& point) const {
  Cell centre = CellOf(point);
  double nearest2 = INFINITY;
  int64_t last = std::max({size_[0], size_[1], size_[2]});
  for (int64_t ring = 0; ring <= last; ++ring) {
    // What lies in a further ring is at least `ring - 1` whole cells away.
    double reach = static_cast<double>(ring - 1) * cell_;
    if (ring > 0 && reach * reach > nearest2) break;
    SearchRing(centre, ring, point, &nearest2);
  }
  return std::sqrt(nearest2);
}

}  // namespace folprom::support
