#include "apps/folprom/synth_strip.h"

#include <algorithm>
#include <utility>

#include "apps/folprom/synth_surface.h"

namespace folprom::cli {

StripMesher::StripMesher(bool ring, uint64_t first_vertex, SurfaceSink* sink)
    : ring_(ring), first_vertex_(first_vertex), sink_(sink), next_vertex_(first_vertex) {}

void StripMesher::AddRow() {
  upper_.used.assign(upper_.samples.u.size(), 0);
  if (rows_ > 0) {
    JoinRows(&middle_, &upper_, &upper_strip_);
    NumberRow(&middle_);
    if (rows_ > 1) SendFaces(lower_, middle_, lower_strip_);
  }
  ++rows_;
  // The oldest row's memory serves the next one.
  std::swap(lower_, middle_);
  std::swap(middle_, upper_);
  std::swap(lower_strip_, upper_strip_);
}

void StripMesher::Finish() {
  NumberRow(&middle_);
  SendFaces(lower_, middle_, lower_strip_);
}

// Walks along both rows at once and steps where the middle of the next edge comes first. A ring
// closes by walking once around both.
void StripMesher::JoinRows(Row* lower, Row* upper, std::vector<StripTriangle>* strip) const {
  const std::vector<double>& lu = lower->samples.u;
  const std::vector<double>& uu = upper->samples.u;
  const auto lower_count = static_cast<uint32_t>(lu.size());
  const auto upper_count = static_cast<uint32_t>(uu.size());
  // A ring of one sample has no edge to walk.
  const uint32_t lower_steps = ring_ && lower_count > 1 ? lower_count : lower_count - 1;
  const uint32_t upper_steps = ring_ && upper_count > 1 ? upper_count : upper_count - 1;
  const uint8_t* const lower_present = lower->samples.present.data();
  const uint8_t* const upper_present = upper->samples.present.data();

  strip->resize(static_cast<size_t>(lower_steps) + upper_steps);
  StripTriangle* out = strip->data();
  uint32_t i = 0, j = 0;
  while (i < lower_steps || j < upper_steps) {
    // Both indices are at most the count, where a ring begins again, one turn later.
    const uint32_t a = i == lower_count ? 0 : i;
    const uint32_t b = j == upper_count ? 0 : j;
    const bool last_a = i + 1 >= lower_count;
    const bool last_b = j + 1 >= upper_count;
    const uint32_t next_a = last_a ? 0 : i + 1;
    const uint32_t next_b = last_b ? 0 : j + 1;
    const double a_middle = lu[a] + (i == lower_count ? 1 : 0) + lu[next_a] + (last_a ? 1 : 0);
    const double b_middle = uu[b] + (j == upper_count ? 1 : 0) + uu[next_b] + (last_b ? 1 : 0);
    const bool step_lower =
        j == upper_steps ||
        (i < lower_steps && a_middle + lower->samples.lean[a] < b_middle + upper->samples.lean[b]);
    const uint32_t next = step_lower ? next_a : next_b | kUpper;
    const bool next_present = step_lower ? lower_present[next_a] : upper_present[next_b];
    if (next_present && lower_present[a] && upper_present[b] &&
        Spans(lower->samples, upper->samples, {a, next, b | kUpper})) {
      lower->used[a] = 1;
      upper->used[b] = 1;
      (step_lower ? lower->used[next_a] : upper->used[next_b]) = 1;
      *out++ = {a, next, b | kUpper};
    }
    i += step_lower ? 1 : 0;
    j += step_lower ? 0 : 1;
  }
  strip->resize(static_cast<size_t>(out - strip->data()));
}

// A triangle across a jump of the depth would join what lies behind to what lies before it.
bool StripMesher::Spans(const SampleRow& lower, const SampleRow& upper,
                        const StripTriangle& triangle) {
  if (lower.depth.empty()) return true;
  double least = 1e300, most = -1e300;
  for (const uint32_t corner : triangle) {
    const double depth = corner < kUpper ? lower.depth[corner] : upper.depth[corner - kUpper];
    least = std::min(least, depth);
    most = std::max(most, depth);
  }
  return most - least <= lower.most_jump;
}

void StripMesher::NumberRow(Row* row) {
  const size_t count = row->used.size();
  row->ids.resize(count);
  for (size_t i = 0; i < count; ++i) {
    row->ids[i] = next_vertex_;
    next_vertex_ += row->used[i];
  }
  if (sink_ == nullptr) return;
  positions_.clear();
  for (size_t i = 0; i < count; ++i) {
    if (row->used[i] == 0) continue;
    const double* p = &row->samples.xyz[3 * i];
    positions_.insert(positions_.end(), p, p + 3);
  }
  sink_->AddVertices(positions_);
}

void StripMesher::SendFaces(const Row& lower, const Row& upper,
                            const std::vector<StripTriangle>& strip) {
  faces_ += strip.size();
  if (sink_ == nullptr) return;
  const auto id = [&](uint32_t corner) {
    return corner < kUpper ? lower.ids[corner] : upper.ids[corner - kUpper];
  };
  triangles_.resize(strip.size());
  for (size_t i = 0; i < strip.size(); ++i) {
    triangles_[i] = {id(strip[i][0]), id(strip[i][1]), id(strip[i][2])};
  }
  sink_->AddFaces(triangles_);
}

}  // namespace folprom::cli
