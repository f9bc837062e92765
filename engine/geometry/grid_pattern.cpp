#include "engine/geometry/grid_pattern.h"

#include <algorithm>

namespace folprom {
namespace {

constexpr uint32_t kMostNeighbours = GridHint::kMostNeighbours;
constexpr uint32_t kMostCandidates = 2 * kMostNeighbours + 1;
/// Squared, in steps: how near a neighbour must be to two steps, none to one, and steps to each
/// other.
constexpr double kNearFar = 0.25, kNearNext = 0.16, kNearStep = 0.09;

struct Candidate {
  Vector3 step;
  uint32_t split;
  bool of_neighbour;
};

}  // namespace

void GridPattern::AddRoot() { past_.emplace_back(); }

void GridPattern::AddSplit(uint32_t parent, uint32_t added) {
  Past& kept = past_[parent];
  kept.before = kept.last;
  kept.before_child = kept.last_child;
  kept.last = added;
  kept.last_child = false;
  Past past;
  past.parent = parent;
  past.last = added;
  past.last_child = true;
  past.before = kept.before;
  past.before_child = kept.before_child;
  past_.push_back(past);
}

GridHint GridPattern::Expect(const Complex& complex, const std::vector<Int3>& positions,
                             uint32_t vertex) const {
  GridHint hint;
  std::array<Vector3, kMostNeighbours> ring;
  std::array<uint32_t, kMostNeighbours>& ids = hint.neighbour;
  std::array<Candidate, kMostCandidates> candidates;
  uint32_t found = 0;
  uint32_t& count = hint.count;
  for (const auto& spoke : complex.Spokes(vertex)) {
    if (count == kMostNeighbours) return hint;
    ids[count] = spoke.target;
    ring[count] = Difference(positions[ids[count]], positions[vertex]);
    ++count;
  }
  const auto fits = [&](const Vector3& step) {
    const double squared = Dot(step, step);
    const Vector3 twice{2 * step[0], 2 * step[1], 2 * step[2]};
    bool far = false;
    for (uint32_t k = 0; k < count; ++k) {
      if (IsNear(ring[k], step, kNearNext * squared)) return false;
      far = far || IsNear(ring[k], twice, kNearFar * squared);
    }
    return far;
  };
  const auto add = [&](uint32_t split, double scale, bool of_neighbour) {
    if (split == kNone || split == past_[vertex].last) return;
    Vector3 step = StepOf(positions, split);
    for (double& value : step) value = value * scale;
    if (!fits(step)) return;
    candidates[found] = {step, split, of_neighbour};
    ++found;
  };
  add(past_[vertex].before, 0.5, false);
  for (uint32_t k = 0; k < count; ++k) {
    add(past_[ids[k]].last, 1, true);
    add(past_[ids[k]].before, 1, true);
  }
  if (found == 0) return hint;

  // The step that most others agree with; neighbours' count twice.
  uint32_t best = 0, most = 0;
  for (uint32_t i = 0; i < found; ++i) {
    const Vector3& step = candidates[i].step;
    uint32_t votes = 0;
    for (uint32_t j = 0; j < found; ++j) {
      if (!IsNear(candidates[j].step, step, kNearStep * Dot(step, step))) continue;
      votes += candidates[j].of_neighbour ? 2 : 1;
    }
    if (votes > most) {
      most = votes;
      best = i;
    }
  }
  const Vector3 chosen = candidates[best].step;
  const double near = kNearStep * Dot(chosen, chosen);
  uint32_t agreeing = 0;
  for (uint32_t j = 0; j < found; ++j) {
    if (!candidates[j].of_neighbour || !IsNear(candidates[j].step, chosen, near)) continue;
    ++agreeing;
    for (size_t i = 0; i < 3; ++i) hint.step[i] = hint.step[i] + candidates[j].step[i];
    if (hint.kind == 0) hint.kind = past_[candidates[j].split].kind;
  }
  const uint32_t own = past_[vertex].before;
  if (hint.kind == 0 && own != kNone) hint.kind = past_[own].kind;
  const auto agrees = [&](uint32_t split) {
    return split != kNone && split != past_[vertex].last &&
           IsNear(StepOf(positions, split), chosen, near);
  };
  for (uint32_t k = 0; k < count; ++k) {
    const Past& past = past_[ids[k]];
    hint.mark[k] = GridHint::kOther;
    if (agrees(past.last)) {
      hint.mark[k] = past.last_child ? GridHint::kChild : GridHint::kParent;
    } else if (agrees(past.before)) {
      hint.mark[k] = past.before_child ? GridHint::kChild : GridHint::kParent;
    }
  }
  for (size_t i = 0; i < 3; ++i) {
    hint.step[i] = agreeing == 0 ? chosen[i] : hint.step[i] / agreeing;
  }
  hint.found = true;
  hint.support = std::min(agreeing, GridHint::kMostSupport);

  const Vector3 twice{2 * hint.step[0], 2 * hint.step[1], 2 * hint.step[2]};
  uint32_t far = 0;
  double least = 1e300;
  for (uint32_t k = 0; k < count; ++k) {
    const Vector3 d{ring[k][0] - twice[0], ring[k][1] - twice[1], ring[k][2] - twice[2]};
    const double squared = Dot(d, d);
    if (squared < least) {
      least = squared;
      far = k;
    }
  }
  hint.far = ring[far];
  hint.far_vertex = ids[far];
  uint32_t sides = 0;
  for (const uint32_t corner : complex.Corners(vertex)) {
    const auto [a, b] = complex.Opposite(corner);
    if ((a == ids[far]) == (b == ids[far])) continue;
    const Vector3 d = Difference(positions[a == ids[far] ? b : a], positions[vertex]);
    for (size_t i = 0; i < 3; ++i) hint.across[i] = hint.across[i] + d[i];
    ++sides;
  }
  if (sides != 2) hint.across = hint.far;
  return hint;
}

}  // namespace folprom
