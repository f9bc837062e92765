#include "engine/connectivity/light_fan_model.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

/// How far a table's value moves to each cut.
constexpr float kRate = 0.017F;
/// Least logarithm of a weight, below the greatest.
constexpr float kLeast = -40;

/// In steps of a table, -1 .. 1.
LaneIntegers StepOf(Lanes x) {
  constexpr float kHalf = 8, kLast = 15;
  return WholeOf(LesserOf(GreaterOf((x + 1) * kHalf, AllLanes(0)), AllLanes(kLast)));
}

void StoreIntegers(LaneIntegers lanes, int32_t* values) {
  std::memcpy(values, &lanes, sizeof lanes);
}

/// Of 65536: a part that leaves something to both sides.
uint32_t Share(float part, float all) {
  constexpr float kLeastShare = 64, kMostShare = 65536 - 64;
  if (!(part > 0)) return static_cast<uint32_t>(kLeastShare);
  return static_cast<uint32_t>(std::clamp(65536 * (part / all), kLeastShare, kMostShare));
}

/// One of `count` by halving what is left. below: sums of their weights.
template <class Coder>
uint32_t CodeByHalves(Coder& coder, const float* below, uint32_t count, uint32_t truth) {
  uint32_t lo = 0, hi = count;
  while (hi - lo > 1) {
    const uint32_t middle = (lo + hi) / 2;
    const uint32_t share = Share(below[hi] - below[middle], below[hi] - below[lo]);
    (coder.Code(share, truth >= middle) ? lo : hi) = middle;
  }
  return lo;
}

}  // namespace

// Learnt from scans of all kinds.
constexpr LightFanModel::Tables LightFanModel::kFirstTables{
    {-3.88F, -4.33F, -3.23F, -3.29F, -2.64F, -2.04F, -1.47F, -1.06F, -0.65F, -0.33F, -0.15F, 0.21F,
     0.36F, 0.99F, 1.39F, 2.19F},
    {-0.57F, -1.50F, -1.27F, -1.33F, 0.11F, -1.00F, -0.76F, -0.66F, -0.57F, -0.58F, -0.40F, -0.07F,
     0.24F, 0.87F, 1.37F, 0.39F},
    {-1.33F, -0.85F, -0.36F, -0.42F, 0.15F, -0.30F, -0.23F, -0.17F, -0.19F, -0.23F, -0.13F, 0.25F,
     0.33F, 0.79F, 0.61F, -0.06F},
    {0.08F, -0.09F, 0.06F, 0.20F, 0.25F, 0.69F, 0.59F, 1.10F, 1.25F, 1.28F, 1.15F, 0.61F, 0.08F,
     -0.38F, -0.83F, -1.01F},
    {0.00F, 0.00F, 0.88F, 1.28F, 0.61F, -0.08F, -0.47F, -0.69F, -0.80F, -0.78F, -0.63F, -0.63F,
     -0.20F, -0.31F, -0.17F, -0.01F},
    {0.49F,  0.42F,  0.37F,  0.28F,  0.18F,  0.08F,  -0.01F, -0.11F, -0.25F, -0.34F, -0.26F,
     -0.24F, -0.22F, -0.12F, -0.12F, -0.13F, -0.32F, 0.04F,  0.21F,  0.11F,  0.17F,  0.09F,
     0.05F,  0.02F,  -0.20F, -0.28F, -0.34F, -0.45F, -0.49F, -0.45F, -0.46F, -0.37F},
    {0.00F, 0.48F, -0.09F, -0.24F, -0.18F, -0.12F, 0.08F, 0.04F, 0.06F, 0.21F,
     0.23F, 0.47F, 0.71F,  0.80F,  0.61F,  0.37F,  0.37F, 0.37F, 0.37F, 0.37F},
    {-2.53F, -0.60F, 0.20F, 0.54F, 0.58F, 0.25F, -0.23F, -0.62F, -0.93F, -0.67F, -0.59F, -1.10F},
    {-1.31F, 0.11F, 0.45F, 0.38F, -0.10F, -0.78F, -1.23F, -1.38F, -0.87F, -0.67F, -0.20F, -0.14F},
    {0.63F, -0.60F}};

LightFanModel::LightFanModel() : hit_({kPlaceBuckets, kOddsBuckets}) {}

void LightFanModel::Measure(const Fan& fan, std::span<const FanSpoke> spokes,
                            const Vector3& second) {
  Row<kMost> x{}, y{}, z{};
  for (uint32_t k = 0; k < places_; ++k) {
    if (fan.IsOutside(k)) break;
    const FanSpoke& spoke = spokes[k];
    x[k] = static_cast<float>(spoke.position[0]);
    y[k] = static_cast<float>(spoke.position[1]);
    z[k] = static_cast<float>(spoke.position[2]);
    steps_.degree[k] = static_cast<uint8_t>(std::min(spoke.degree, kMostDegree));
    const auto age = static_cast<uint32_t>(spoke.age * kAges);
    steps_.age[k] = static_cast<uint8_t>(age + (spoke.younger ? kAges : 0));
    const auto rest = static_cast<uint32_t>(std::bit_width(spoke.splits_past));
    steps_.rest[k] = static_cast<uint8_t>(std::min(rest, kRests - 1));
  }
  x[places_] = x[0], y[places_] = y[0], z[places_] = z[0];
  Lanes normal_x = AllLanes(0), normal_y = normal_x, normal_z = normal_x;
  for (uint32_t k = 0; k < groups_ * kLanes; k += kLanes) {
    const Lanes ax = LoadLanes(&x[k]), ay = LoadLanes(&y[k]), az = LoadLanes(&z[k]);
    const Lanes bx = LoadLanes(&x[k + 1]), by = LoadLanes(&y[k + 1]), bz = LoadLanes(&z[k + 1]);
    normal_x = normal_x + (ay * bz - az * by);
    normal_y = normal_y + (az * bx - ax * bz);
    normal_z = normal_z + (ax * by - ay * bx);
  }
  const float nx = SumOf(normal_x), ny = SumOf(normal_y), nz = SumOf(normal_z);
  const float length = std::sqrt(nx * nx + ny * ny + nz * nz);
  const float inverse = length > 0 ? 1 / length : 0;
  const auto cx = static_cast<float>(second[0]), cy = static_cast<float>(second[1]),
             cz = static_cast<float>(second[2]);
  // Along it a neighbour is to the left of the way from the first child to the second.
  const float lx = (ny * cz - nz * cy) * inverse, ly = (nz * cx - nx * cz) * inverse,
              lz = (nx * cy - ny * cx) * inverse;
  const float between = std::max(cx * cx + cy * cy + cz * cz, 0.25F);
  for (uint32_t k = 0; k < groups_ * kLanes; k += kLanes) {
    const Lanes px = LoadLanes(&x[k]), py = LoadLanes(&y[k]), pz = LoadLanes(&z[k]);
    const Lanes ahead = px * cx + py * cy + pz * cz, left = px * lx + py * ly + pz * lz;
    const Lanes far = px * px + py * py + pz * pz, both = 2 * (far - ahead + between);
    StoreIntegers(StepOf(3.4641016F * left / both), &steps_.shape[k]);
    const Lanes lean = 2 * ahead - between;
    StoreIntegers(StepOf(lean / (between + Magnitude(lean))), &steps_.lean[k]);
    const Lanes along = far - ahead;
    const Lanes across = GreaterOf(Magnitude(left) + Magnitude(along), AllLanes(1e-6F));
    StoreIntegers(StepOf(along / across), &steps_.angle[k]);
  }
}

void LightFanModel::WeighArcs() {
  const uint32_t n = places_;
  for (uint32_t d = 1; d < n; ++d) {
    arc_[d] = std::clamp(tables_.arc_second[std::min(d - 1, kArcs - 1)] +
                             tables_.arc_first[std::min(n - 1 - d, kArcs - 1)],
                         kLeast, -kLeast);
  }
  arc_[0] = 0;
  for (uint32_t d = n; d < groups_ * kLanes; ++d) arc_[d] = 0;
  for (uint32_t d = 0; d < groups_ * kLanes; d += kLanes) {
    StoreLanes(FastExp2(LoadLanes(&arc_[d])), &arc_[d]);
  }
}

void LightFanModel::Weigh(const Fan& fan) {
  const uint32_t n = places_, whole = groups_ * kLanes;
  float* const from = from_.data() + kMost;
  // Neighbours between the pivots go to the second child.
  float inside = 0, most_from = kLeast * 100, most_to = most_from;
  for (uint32_t k = 0; k < n; ++k) {
    float begin = 0, end = 0, between = 0;
    if (fan.IsOutside(k)) {
      begin = end = tables_.outside[0];
      between = tables_.outside[1];
    } else {
      const auto shape = static_cast<size_t>(steps_.shape[k]),
                 lean = static_cast<size_t>(steps_.lean[k]);
      const float pivot = tables_.pivot_lean[lean] +
                          tables_.pivot_angle[static_cast<size_t>(steps_.angle[k])] +
                          tables_.pivot_degree[steps_.degree[k]] +
                          tables_.pivot_age[steps_.age[k]] + tables_.pivot_rest[steps_.rest[k]];
      begin = tables_.shape[kSteps - 1 - shape] + pivot;
      end = tables_.shape[shape] + pivot;
      between = tables_.lean[lean];
    }
    to_[k] = end + inside;
    inside = inside + between;
    from[k] = begin - inside;
    most_to = std::max(most_to, to_[k]);
    most_from = std::max(most_from, from[k]);
  }
  most_to = std::max(most_to, most_to + inside);
  for (uint32_t k = 0; k < n; ++k) to_[n + k] = to_[k] + inside;
  for (uint32_t k = 0; k < 2 * n; k += kLanes) {
    StoreLanes(FastExp2(GreaterOf(LoadLanes(&to_[k]) - most_to, AllLanes(kLeast))), &to_[k]);
  }
  for (uint32_t k = 0; k < whole; k += kLanes) {
    StoreLanes(FastExp2(GreaterOf(LoadLanes(&from[k]) - most_from, AllLanes(kLeast))), &from[k]);
  }
  for (uint32_t k = n; k < whole; ++k) to_[n + k] = 0;
  // Whoever looks at any place before or behind finds that no cut begins there.
  for (uint32_t k = n; k < 2 * n + kLanes; ++k) from[k] = 0;
  WeighArcs();
  for (uint32_t k = 0; k < whole; k += kLanes) {
    const Lanes begin = LoadLanes(&from[k]);
    Lanes sum = AllLanes(0);
    for (uint32_t d = 1; d < n; ++d) {
      const Lanes weight = begin * LoadLanes(&to_[k + d]) * arc_[d];
      StoreLanes(weight, &weight_[d][k]);
      sum = sum + weight;
    }
    StoreLanes(sum, &begins_[k]);
  }
  Lanes total = AllLanes(0);
  for (uint32_t k = 0; k < whole; k += kLanes) total = total + LoadLanes(&begins_[k]);
  total_ = SumOf(total);
}

FanCut LightFanModel::Likeliest(float* part) const {
  const uint32_t n = places_;
  float best = -1;
  FanCut cut;
  for (uint32_t k = 0; k < groups_ * kLanes; k += kLanes) {
    Lanes most = AllLanes(-1);
    LaneIntegers at{};
    for (uint32_t d = 1; d < n; ++d) {
      const Lanes weight = LoadLanes(&weight_[d][k]);
      const LaneIntegers more = weight > most;
      at = more ? at * 0 + static_cast<int32_t>(d) : at;
      most = GreaterOf(most, weight);
    }
    for (uint32_t lane = 0; lane < kLanes; ++lane) {
      if (!(most[lane] > best)) continue;
      best = most[lane];
      const uint32_t begin = k + lane, end = begin + static_cast<uint32_t>(at[lane]);
      cut = {begin, end < n ? end : end - n};
    }
  }
  *part = best / total_;
  return cut;
}

template <class Coder>
FanCut LightFanModel::CodeOther(Coder& coder, FanCut likeliest, FanCut truth) const {
  const uint32_t n = places_, not_at = Distance(likeliest);
  const float gone = weight_[not_at][likeliest.begin];
  std::array<float, kMost + 1> below;
  below[0] = 0;
  for (uint32_t k = 0; k < n; ++k) {
    const float left = k == likeliest.begin ? std::max(begins_[k] - gone, 0.0F) : begins_[k];
    below[k + 1] = below[k] + left;
  }
  FanCut cut;
  cut.begin = CodeByHalves(coder, below.data(), n, truth.begin);
  const bool same = cut.begin == likeliest.begin;
  for (uint32_t d = 1; d < n; ++d) {
    below[d] = below[d - 1] + (same && d == not_at ? 0 : weight_[d][cut.begin]);
  }
  const uint32_t d = 1 + CodeByHalves(coder, below.data(), n - 1, Distance(truth) - 1);
  cut.end = cut.begin + d < n ? cut.begin + d : cut.begin + d - n;
  return cut;
}

void LightFanModel::Learn(const Fan& fan, FanCut truth) {
  const uint32_t n = places_;
  const float part = -kRate / total_;
  for (uint32_t d = 1; d < n; ++d) {
    Lanes sum = AllLanes(0);
    for (uint32_t k = 0; k < groups_ * kLanes; k += kLanes) {
      sum = sum + LoadLanes(&weight_[d][k]);
    }
    const float error = part * SumOf(sum) + (d == Distance(truth) ? kRate : 0);
    float& second = tables_.arc_second[std::min(d - 1, kArcs - 1)];
    float& first = tables_.arc_first[std::min(n - 1 - d, kArcs - 1)];
    second = second + error;
    first = first + error;
  }
  // Cuts by where they end, those that run over place 0 by n + that.
  Row<2 * kMost> ending{};
  for (uint32_t e = 0; e < 2 * n; e += kLanes) {
    Lanes begun = AllLanes(0);
    for (uint32_t d = 1; d < n; ++d) begun = begun + LoadLanes(&from_[kMost + e - d]) * arc_[d];
    StoreLanes(begun * LoadLanes(&to_[e]), &ending[e]);
  }
  // Of cuts that hold the face at place 0: those that begin there, or run over it.
  float first_inside = begins_[0];
  Row<kMost> begins, ends;
  for (uint32_t k = 0; k < n; ++k) {
    if (k > 0) first_inside = first_inside + ending[n + k];
    begins[k] = part * begins_[k];
    ends[k] = part * (ending[k] + ending[n + k]);
  }
  begins[truth.begin] = begins[truth.begin] + kRate;
  ends[truth.end] = ends[truth.end] + kRate;
  const bool holds_first = truth.begin == 0 || (truth.begin > truth.end && truth.end > 0);
  LearnPlaces(fan, begins, ends, part * first_inside + (holds_first ? kRate : 0));
}

void LightFanModel::LearnPlaces(const Fan& fan, const Row<kMost>& begins, const Row<kMost>& ends,
                                float first_inside) {
  float inside = first_inside;  // of the face behind a place
  for (uint32_t k = 0; k < places_; ++k) {
    if (k > 0) inside = inside + (begins[k] - ends[k]);
    const float between = inside - begins[k], pivot = begins[k] + ends[k];
    if (fan.IsOutside(k)) {
      tables_.outside[0] += pivot;
      tables_.outside[1] += between;
      return;
    }
    const auto shape = static_cast<size_t>(steps_.shape[k]),
               lean = static_cast<size_t>(steps_.lean[k]);
    tables_.shape[kSteps - 1 - shape] += begins[k];
    tables_.shape[shape] += ends[k];
    tables_.lean[lean] += between;
    tables_.pivot_lean[lean] += pivot;
    tables_.pivot_angle[static_cast<size_t>(steps_.angle[k])] += pivot;
    tables_.pivot_degree[steps_.degree[k]] += pivot;
    tables_.pivot_age[steps_.age[k]] += pivot;
    tables_.pivot_rest[steps_.rest[k]] += pivot;
  }
}

template <class Coder>
FanCut LightFanModel::Code(Coder& coder, const Fan& fan, std::span<const FanSpoke> spokes,
                           const Vector3& second, FanCut truth) {
  places_ = fan.places;
  groups_ = (places_ + kLanes - 1) / kLanes;
  Measure(fan, spokes, second);
  Weigh(fan);
  float part = 0;
  FanCut cut = Likeliest(&part);
  const auto bucket = static_cast<uint32_t>(std::min(part * kOddsBuckets, kOddsBuckets - 1.0F));
  const int32_t odds = detail::kStretch[static_cast<size_t>(std::min(part * 4096, 4095.0F))];
  const bool hit = truth.begin == cut.begin && truth.end == cut.end;
  if (!hit_.Code(coder, {std::min(places_ - 3, kPlaceBuckets - 1), bucket}, 0, hit, {odds})) {
    cut = CodeOther(coder, cut, truth);
  }
  Learn(fan, cut);
  return cut;
}

template FanCut LightFanModel::Code<BitEncoder>(BitEncoder&, const Fan&, std::span<const FanSpoke>,
                                                const Vector3&, FanCut);
template FanCut LightFanModel::Code<BitDecoder>(BitDecoder&, const Fan&, std::span<const FanSpoke>,
                                                const Vector3&, FanCut);

}  // namespace folprom
