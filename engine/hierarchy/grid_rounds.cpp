#include "engine/hierarchy/grid_rounds.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace folprom {
namespace {

constexpr uint32_t kNone = ~uint32_t{0};
/// Part of the vertices that must have six faces before labels are tried, and lie on grids at last.
constexpr double kLeastShare = 0.5;
/// A component is a grid if it has so many vertices and at most this part of its labels conflict.
constexpr uint32_t kLeastVertices = 64;
constexpr double kMostConflicts = 0.01;

struct Label {
  int32_t row = 0, column = 0;
  bool operator==(const Label&) const = default;
};

struct Component {
  uint32_t vertices = 0;
  uint64_t conflicts = 0, agreements = 0;
  /// Squared lengths of the edges along (0, 1), (1, 0) and (1, -1), and how many they are.
  std::array<double, 3> squares{};
  std::array<uint32_t, 3> edges{};
  bool is_grid = false;
  std::array<double, 2> spacing{};  ///< of rows and columns that are left
  std::array<uint32_t, 2> level{};  ///< rows and columns left are multiples of 2^level
};

class GridLabels {
 public:
  GridLabels(std::span<const Int3> positions, std::span<const Face> faces)
      : positions_(positions),
        faces_(faces),
        label_(positions.size()),
        component_(positions.size(), kNone),
        visited_(faces.size(), 0) {}

  bool MayBeGrid() const {
    std::vector<uint8_t> corners(positions_.size(), 0);
    for (const Face& face : faces_) {
      for (uint32_t v : face) corners[v] = static_cast<uint8_t>(std::min(corners[v] + 1, 7));
    }
    const auto six = std::count(corners.begin(), corners.end(), 6);
    return static_cast<double>(six) >= kLeastShare * static_cast<double>(positions_.size());
  }

  void Flood() {
    LinkFaces();
    for (uint32_t f = 0; f < faces_.size(); ++f) {
      if (visited_[f] == 0) FloodFrom(f);
    }
    size_t on_grid = 0;
    for (Component& component : components_) {
      const auto tests = static_cast<double>(component.conflicts + component.agreements);
      component.is_grid = component.vertices >= kLeastVertices &&
                          static_cast<double>(component.conflicts) <= kMostConflicts * tests;
      if (component.is_grid) on_grid += component.vertices;
    }
    found_ = on_grid > 0 &&
             static_cast<double>(on_grid) >= kLeastShare * static_cast<double>(positions_.size());
    if (found_) ChooseAxes();
  }
  bool found() const { return found_; }

  std::vector<GridStep> NextRound() {
    std::vector<uint32_t> axis(components_.size());
    for (size_t i = 0; i < components_.size(); ++i) {
      axis[i] = components_[i].spacing[0] <= components_[i].spacing[1] ? 0 : 1;
    }
    std::vector<GridStep> steps;
    for (const auto& [key, v] : by_key_) {
      const Component& component = components_[component_[v]];
      const uint32_t along = axis[component_[v]];
      const std::array<int32_t, 2> place{label_[v].row, label_[v].column};
      const auto is_left = [&](uint32_t a) {
        return (place[a] & ((1 << component.level[a]) - 1)) == 0;
      };
      const int32_t step = 1 << component.level[along];
      if (!is_left(0) || !is_left(1) || (place[along] & step) == 0) continue;
      GridStep out{v, {}};
      for (size_t side = 0; side < 2; ++side) {
        Label target = label_[v];
        (along == 0 ? target.row : target.column) += side == 0 ? -step : step;
        out.targets[side] = VertexAt(component_[v], target);
      }
      steps.push_back(out);
    }
    for (size_t i = 0; i < components_.size(); ++i) {
      components_[i].spacing[axis[i]] *= 2;
      ++components_[i].level[axis[i]];
    }
    return steps;
  }

 private:
  void LinkFaces() {
    struct HalfEdge {
      uint32_t from, to, corner;  ///< corner: 3 * face + that opposite to the edge
    };
    std::vector<HalfEdge> edges;
    edges.reserve(3 * faces_.size());
    for (uint32_t f = 0; f < faces_.size(); ++f) {
      for (uint32_t i = 0; i < 3; ++i) {
        edges.push_back({faces_[f][(i + 1) % 3], faces_[f][(i + 2) % 3], 3 * f + i});
      }
    }
    const auto key = [](uint32_t a, uint32_t b) { return uint64_t{a} << 32 | b; };
    std::sort(edges.begin(), edges.end(), [&](const HalfEdge& l, const HalfEdge& r) {
      const uint64_t left = key(std::min(l.from, l.to), std::max(l.from, l.to));
      const uint64_t right = key(std::min(r.from, r.to), std::max(r.from, r.to));
      return left != right ? left < right : l.corner < r.corner;
    });
    opposite_.assign(3 * faces_.size(), kNone);
    for (size_t i = 0; i + 1 < edges.size(); ++i) {
      const HalfEdge &a = edges[i], &b = edges[i + 1];
      if (a.from != b.to || a.to != b.from || a.from == a.to) continue;
      opposite_[a.corner] = b.corner;
      opposite_[b.corner] = a.corner;
    }
  }

  void FloodFrom(uint32_t first) {
    const auto index = static_cast<uint32_t>(components_.size());
    components_.emplace_back();
    Component& component = components_.back();
    constexpr std::array<Label, 3> kStart{Label{0, 0}, Label{0, 1}, Label{1, 0}};
    for (size_t i = 0; i < 3; ++i) Give(faces_[first][i], kStart[i], index, &component);
    visited_[first] = 1;
    queue_.assign(1, first);
    for (size_t head = 0; head < queue_.size(); ++head) {
      const uint32_t f = queue_[head];
      for (uint32_t i = 0; i < 3; ++i) {
        const uint32_t a = faces_[f][(i + 1) % 3], b = faces_[f][(i + 2) % 3], c = faces_[f][i];
        Measure(a, b, index, &component);
        const uint32_t corner = opposite_[3 * f + i];
        if (corner == kNone) continue;
        const Label expected{label_[a].row + label_[b].row - label_[c].row,
                             label_[a].column + label_[b].column - label_[c].column};
        Give(faces_[corner / 3][corner % 3], expected, index, &component);
        if (visited_[corner / 3] != 0) continue;
        visited_[corner / 3] = 1;
        queue_.push_back(corner / 3);
      }
    }
  }

  void Give(uint32_t v, const Label& label, uint32_t index, Component* component) {
    if (component_[v] == kNone) {
      component_[v] = index;
      label_[v] = label;
      ++component->vertices;
    } else if (component_[v] == index && label_[v] == label) {
      ++component->agreements;
    } else {
      ++component->conflicts;
    }
  }

  void Measure(uint32_t a, uint32_t b, uint32_t index, Component* component) {
    if (component_[a] != index || component_[b] != index) return;
    const int32_t rows = label_[b].row - label_[a].row;
    const int32_t columns = label_[b].column - label_[a].column;
    const size_t kind = rows == 0 ? 0 : (columns == 0 ? 1 : 2);
    const double x = static_cast<double>(positions_[a].x) - positions_[b].x;
    const double y = static_cast<double>(positions_[a].y) - positions_[b].y;
    const double z = static_cast<double>(positions_[a].z) - positions_[b].z;
    component->squares[kind] += x * x + y * y + z * z;
    ++component->edges[kind];
  }

  // Which of the three directions of edges is the diagonal, only lengths tell. Labels change so
  // that it is (1, -1).
  void ChooseAxes() {
    std::vector<size_t> diagonal(components_.size());
    for (size_t i = 0; i < components_.size(); ++i) {
      Component& component = components_[i];
      std::array<double, 3> mean{};
      for (size_t k = 0; k < 3; ++k) {
        mean[k] = component.edges[k] == 0 ? 0 : component.squares[k] / component.edges[k];
      }
      diagonal[i] = static_cast<size_t>(std::max_element(mean.begin(), mean.end()) - mean.begin());
      // Steps from row to row, and from column to column.
      constexpr std::array<std::array<size_t, 2>, 3> kAxes{{{1, 2}, {0, 2}, {1, 0}}};
      for (size_t k = 0; k < 2; ++k) component.spacing[k] = std::sqrt(mean[kAxes[diagonal[i]][k]]);
    }
    for (uint32_t v = 0; v < label_.size(); ++v) {
      if (component_[v] == kNone || !components_[component_[v]].is_grid) continue;
      Label& label = label_[v];
      if (diagonal[component_[v]] == 0) label = {label.row + label.column, -label.column};
      if (diagonal[component_[v]] == 1) label = {label.row + label.column, -label.row};
      by_key_.push_back({KeyOf(component_[v], label), v});
    }
    std::sort(by_key_.begin(), by_key_.end());
  }

  /// Components of 64 vertices and more, and labels below 2^21: both fit for 2^24 vertices.
  static uint64_t KeyOf(uint32_t component, const Label& label) {
    constexpr int64_t kMiddle = 1 << 20;
    const auto part = [&](int32_t value) {
      return static_cast<uint64_t>(std::clamp<int64_t>(value + kMiddle, 0, 2 * kMiddle - 1));
    };
    return uint64_t{component} << 42 | part(label.row) << 21 | part(label.column);
  }
  uint32_t VertexAt(uint32_t component, const Label& label) const {
    const uint64_t key = KeyOf(component, label);
    const auto found =
        std::lower_bound(by_key_.begin(), by_key_.end(), std::pair{key, uint32_t{0}});
    return found != by_key_.end() && found->first == key ? found->second : GridStep::kNoTarget;
  }

  std::span<const Int3> positions_;
  std::span<const Face> faces_;
  std::vector<Label> label_;
  std::vector<uint32_t> component_;
  std::vector<uint8_t> visited_;
  std::vector<uint32_t> opposite_;  ///< per corner: that beyond its opposite edge
  std::vector<Component> components_;
  std::vector<uint32_t> queue_;
  std::vector<std::pair<uint64_t, uint32_t>> by_key_;
  bool found_ = false;
};

}  // namespace

std::vector<std::vector<GridStep>> PlanGridRounds(std::span<const Int3> positions,
                                                  std::span<const Face> faces,
                                                  uint32_t most_rounds) {
  std::vector<std::vector<GridStep>> rounds;
  GridLabels labels(positions, faces);
  if (!labels.MayBeGrid()) return rounds;
  labels.Flood();
  if (!labels.found()) return rounds;
  for (uint32_t round = 0; round < most_rounds; ++round) rounds.push_back(labels.NextRound());
  return rounds;
}

}  // namespace folprom
