#include "engine/geometry/light_position_model.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/entropy/bit_coder.h"
#include "engine/geometry/ring_buckets.h"

namespace folprom {
namespace {

constexpr uint32_t kWidths = 16;
/// Of the places, on planes or not, of no, one and two coordinates before: 1 + 3 + 9.
constexpr uint32_t kPlaces = 3, kKnown = 13;
constexpr std::array<uint32_t, 3> kFirstKnown{0, 1, 4};
constexpr uint32_t kMassSteps = 28;

/// On the lattice without its planes, the cell `at`, which is not on one, has the number at - (the
/// number of planes below). The cell of a number.
int32_t CellBesidePlanes(std::span<const int32_t> planes, int32_t number) {
  size_t lo = 0, hi = planes.size();
  while (lo < hi) {
    const size_t middle = (lo + hi) / 2;
    if (planes[middle] - static_cast<int32_t>(middle) <= number) {
      lo = middle + 1;
    } else {
      hi = middle;
    }
  }
  return number + static_cast<int32_t>(lo);
}

}  // namespace

/// The vertex under way. Offsets and lengths in lattice units.
struct LightPositionModel::Vertex : LightSpokes::Vertex {
  uint32_t count, eccentricity;  ///< buckets
  double inverse;                ///< of the spacing
  std::array<int32_t, 3> cells{};
  Vector3 offset{0, 0, 0};  ///< of the coordinates that are coded
  /// By axis, what its regression follows: the ring's mean and direction, in spacings.
  std::array<std::array<double, 2>, 3> features{};
  double miss_before = 0, variance_before = 1;
  uint32_t known = 0;  ///< places of the coordinates that are coded

  double unit(uint32_t axis) const { return static_cast<double>(uint64_t{1} << shifts[axis]); }
  double origin(uint32_t axis) const { return static_cast<double>(At(old, axis)) + 0.5; }
  void Place(uint32_t axis, int32_t cell) {
    cells[axis] = cell;
    offset[axis] = (static_cast<double>(cell) + 0.5) * unit(axis) - origin(axis);
  }
};

double LightPositionModel::InSpacings(double length, const Vertex& vertex) {
  // A hub with many neighbours next to it may have others very far away.
  constexpr double kMost = 64;
  return std::clamp(length * vertex.inverse, -kMost, kMost);
}

LightPositionModel::LightPositionModel(const std::array<int32_t, 3>& lo,
                                       const std::array<int32_t, 3>& hi)
    : lo_(lo),
      hi_(hi),
      fit_(kCountBuckets, OnlineRegression<2>({2, 0})),
      along_scale_(2 * kCountBuckets * kEccentricityBuckets, 1),
      across_scale_(kWidths, 1),
      cells_{LightCellModel(kSideBuckets), LightCellModel(kSideBuckets * kSideBuckets),
             LightCellModel()},
      beside_planes_(cells_),
      planes_cells_(cells_),
      on_plane_(kKnown * 2 * kMassSteps, kEvenState) {}

template <class Coder>
int32_t LightPositionModel::CodeCell(Coder& coder, uint32_t step, double mean, double scale,
                                     uint32_t side_context, int32_t truth, Vertex* vertex) {
  constexpr double kLeastScale = 0.04;
  const uint32_t axis = vertex->ring.axes[step], shift = vertex->shifts[axis];
  const int32_t lo = vertex->lo[axis], hi = vertex->hi[axis];
  const CellLogistic density(mean, std::max(scale, kLeastScale));
  const uint32_t before = kFirstKnown[step] + vertex->known;
  vertex->known = vertex->known * kPlaces;
  const std::span<const int32_t> on =
      planes_ == nullptr ? std::span<const int32_t>() : planes_->On(axis);
  if (on.size() < 2) return cells_[step].Code(coder, density, lo, hi, truth, side_context);
  // The planes on either side of the prediction.
  const double near = std::clamp(mean, static_cast<double>(lo), static_cast<double>(hi));
  const double unit = vertex->unit(axis), near_unit = std::floor(near * unit);
  const size_t below = planes_->Below(axis, static_cast<int64_t>(near_unit));
  const size_t next = std::clamp<size_t>(below, 1, on.size() - 1);
  const int64_t gap = int64_t{on[next]} - on[next - 1];
  if (gap < int64_t{2} << shift) {
    return cells_[step].Code(coder, density, lo, hi, truth, side_context);
  }
  const double mass = density.Mass(on[next - 1] >> shift) + density.Mass(on[next] >> shift);
  const uint32_t mass_step = OddsStep<1>((mass + 1e-9) / (1 - mass + 1e-9), 1, -10, kMassSteps);
  const int32_t old = At(vertex->old, axis) >> shift;
  const size_t old_plane = planes_->Below(axis, int64_t{old} << shift);
  const bool old_on = old_plane < on.size() && on[old_plane] >> shift == old;
  bool is_on = false;
  int32_t plane = 0;
  if constexpr (Coder::kEncoding) {
    const size_t place = planes_->Below(axis, int64_t{truth} << shift);
    is_on = place < on.size() && on[place] >> shift == truth;
    plane = static_cast<int32_t>(place);
  }
  is_on =
      CodePlain(coder, &on_plane_[(before * 2 + (old_on ? 1 : 0)) * kMassSteps + mass_step], is_on);
  vertex->known = vertex->known + (is_on ? 2 : 1);
  if (is_on) {
    const double per_gap = unit / static_cast<double>(gap);
    const double behind = (near * unit - on[next - 1]) / static_cast<double>(gap);
    const CellLogistic planes_density(static_cast<double>(next - 1) + behind + 0.5,
                                      std::max(scale * per_gap, kLeastScale));
    plane = planes_cells_[step].Code(coder, planes_density, 0, static_cast<int32_t>(on.size()) - 1,
                                     plane, side_context);
    return on[static_cast<size_t>(plane)] >> shift;
  }
  if (shift > 0) return beside_planes_[step].Code(coder, density, lo, hi, truth, side_context);
  const bool is_inside = below < on.size() && on[below] == static_cast<int32_t>(near_unit);
  CellLogistic beside = density;
  beside.mean = (is_inside ? near_unit : near) - static_cast<double>(below);
  const int32_t number = beside_planes_[step].Code(
      coder, beside, lo, hi - static_cast<int32_t>(on.size()), truth - plane, side_context);
  return CellBesidePlanes(on, number);
}

/// Along the surface.
template <class Coder>
void LightPositionModel::CodeAlong(Coder& coder, uint32_t step, int32_t truth, Vertex* vertex) {
  constexpr double kLeastVariance = 0.02;
  const LightRing& ring = vertex->ring;
  const uint32_t axis = ring.axes[step], first = ring.axes[0];
  const double slope = step == 0 ? 0 : ring.covariance / vertex->variance_before;
  const double variance = std::max(ring.variance[step] - slope * ring.covariance,
                                   kLeastVariance * ring.spacing * ring.spacing);
  if (step == 0) vertex->variance_before = variance;
  const double width = std::sqrt(variance), straight = vertex->expected[axis];
  const double mean = straight + slope * vertex->miss_before;
  const uint32_t place =
      (step * kCountBuckets + vertex->count) * kEccentricityBuckets + vertex->eccentricity;
  const double unit = vertex->unit(axis);
  const double scale = kScalePerMiss * along_scale_.Of(place) * width / unit;
  uint32_t side = SideBucket(straight * vertex->inverse);
  if (step == 1) side = side * kSideBuckets + SideBucket(vertex->offset[first] * vertex->inverse);
  vertex->Place(axis, CodeCell(coder, step, (vertex->origin(axis) + mean) / unit, scale, side,
                               truth, vertex));
  const double offset = vertex->offset[axis];
  vertex->miss_before = offset - straight;
  if constexpr (kLearns<Coder>) {
    along_scale_.Learn(place, std::fabs(offset - mean) / width);
    fit_[vertex->count].Learn(vertex->features[axis], InSpacings(offset, *vertex));
  }
}

/// Across the surface.
template <class Coder>
void LightPositionModel::CodeAcross(Coder& coder, int32_t truth, Vertex* vertex) {
  const LightRing& ring = vertex->ring;
  const uint32_t axis = vertex->ring.axes[2];
  const double unit = vertex->unit(axis);
  const double bent = ring.Across(vertex->offset[ring.axes[0]], vertex->offset[ring.axes[1]]);
  const double width = ring.miss + 0.1 * ring.range + 0.25 * unit;
  const uint32_t bucket = OddsStep<1>(width / unit, 1, -3, kWidths);
  const double scale = kScalePerMiss * across_scale_.Of(bucket) * width / unit;
  vertex->Place(axis,
                CodeCell(coder, 2, (vertex->origin(axis) + bent) / unit, scale, 0, truth, vertex));
  if constexpr (kLearns<Coder>) {
    across_scale_.Learn(bucket, std::fabs(vertex->offset[axis] - bent) / width);
  }
}

template <class Coder>
void LightPositionModel::CodeCells(Coder& coder, const std::array<int32_t, 3>& truth, Meters meters,
                                   Vertex* vertex) {
  coder.SetMeter(meters.tangential);
  for (uint32_t step = 0; step < 2; ++step) {
    CodeAlong(coder, step, truth[vertex->ring.axes[step]], vertex);
  }
  coder.SetMeter(meters.normal);
  CodeAcross(coder, truth[vertex->ring.axes[2]], vertex);
}

bool LightPositionModel::PaysOnSpoke(const Vertex& vertex, const std::array<int32_t, 3>& truth) {
  // What is told so gets cheaper: 2.5 bits in 1/1024 until it must have shown whether it pays.
  constexpr uint32_t kTrials = 4096;
  constexpr uint64_t kPatience = 2560;
  const uint64_t patience = trials_ < kTrials ? kPatience : 0;
  trials_ += trials_ < kTrials ? 1 : 0;
  if (!spokes_.Finds(vertex, truth)) return false;
  PlainState* flag = spokes_.flag();
  TrialCoder on, off;
  Vertex trial = vertex;
  CodePlain(on, flag, true);
  if (!spokes_.Code(on, vertex, truth, &trial.cells)) {
    for (uint32_t step = 0; step < 2; ++step) {
      trial.Place(vertex.ring.axes[step], truth[vertex.ring.axes[step]]);
    }
    CodeAcross(on, truth[vertex.ring.axes[2]], &trial);
  }
  Vertex beside = vertex;
  CodePlain(off, flag, false);
  CodeCells(off, truth, {}, &beside);
  return on.cost() < off.cost() + patience;
}

template <class Coder>
std::array<int32_t, 3> LightPositionModel::Code(
    Coder& coder, const Int3& old, const LightRing& ring, const std::array<uint8_t, 3>& shifts,
    const std::array<int32_t, 3>& truth, uint64_t* tangential_meter, uint64_t* normal_meter) {
  Vertex vertex{{old, ring, shifts, {}, {}, {}},
                CountBucket(ring),
                EccentricityBucket(ring),
                1 / ring.spacing};
  for (uint32_t axis = 0; axis < 3; ++axis) {
    vertex.features[axis] = {InSpacings(ring.mean[axis], vertex),
                             InSpacings(ring.direction[axis], vertex)};
    vertex.expected[axis] = fit_[vertex.count].Predict(vertex.features[axis]) * ring.spacing;
    vertex.lo[axis] = lo_[axis] >> shifts[axis];
    vertex.hi[axis] = hi_[axis] >> shifts[axis];
  }
  if (!spokes_.Asks(ring.count)) {
    CodeCells(coder, truth, {tangential_meter, normal_meter}, &vertex);
    return vertex.cells;
  }
  coder.SetMeter(tangential_meter);
  bool on_spoke = false;
  if constexpr (Coder::kEncoding) on_spoke = PaysOnSpoke(vertex, truth);
  on_spoke = CodePlain(coder, spokes_.flag(), on_spoke);
  spokes_.Learn(on_spoke);
  if (!on_spoke) {
    CodeCells(coder, truth, {tangential_meter, normal_meter}, &vertex);
    return vertex.cells;
  }
  if (!spokes_.Code(coder, vertex, truth, &vertex.cells)) {
    for (uint32_t step = 0; step < 2; ++step) {
      vertex.Place(vertex.ring.axes[step], vertex.cells[vertex.ring.axes[step]]);
    }
    coder.SetMeter(normal_meter);
    CodeAcross(coder, truth[vertex.ring.axes[2]], &vertex);
  }
  return vertex.cells;
}

#define FOLPROM_INSTANTIATE(Coder)                                          \
  template std::array<int32_t, 3> LightPositionModel::Code<Coder>(          \
      Coder&, const Int3&, const LightRing&, const std::array<uint8_t, 3>&, \
      const std::array<int32_t, 3>&, uint64_t*, uint64_t*);
FOLPROM_INSTANTIATE(BitEncoder)
FOLPROM_INSTANTIATE(BitDecoder)
#undef FOLPROM_INSTANTIATE

}  // namespace folprom
