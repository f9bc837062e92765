#include "engine/geometry/lattice_coder.h"

#include <algorithm>
#include <cmath>

#include "engine/entropy/bit_coder.h"
#include "engine/geometry/buckets.h"
#include "engine/geometry/light_position_model.h"
#include "engine/geometry/ring_buckets.h"

namespace folprom {
namespace {

/// What the new vertex's offset along an axis may follow, in spacings. A hub with many neighbours
/// next to it may have others very far away.
std::array<double, 5> Features(const RingShape& ring, uint32_t axis) {
  const double inverse = 1 / ring.spacing;
  const auto feature = [&](const Vector3& from) {
    constexpr double kMost = 64;
    return std::clamp(from[axis] * inverse, -kMost, kMost);
  };
  return {feature(ring.mean), feature(ring.direction), feature(ring.reach),
          feature(ring.area_centre), feature(ring.rim_centre)};
}

/// Of the neighbours along axes a and b.
double Covariance(const RingShape& ring, uint32_t a, uint32_t b) {
  constexpr uint32_t kPlace[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
  return ring.covariance[kPlace[a][b]];
}

}  // namespace

LatticeCoder::LatticeCoder(const Int3& lo, const Int3& hi, LatticeSettings settings)
    : lo_{lo.x, lo.y, lo.z},
      hi_{hi.x, hi.y, hi.z},
      has_density_(settings.density_step > 0),
      tangential_({2 * 6 * kCountBuckets, 9 * 9 * 2, 2 * 16}, settings.mixers),
      density_(std::max(settings.density_step, 1u)),
      normal_({16 * 4, 16 * 6}, settings.mixers),
      tangential_fit_(kCountBuckets, OnlineRegression<5>({2, 0, 0, 0, 0})),
      tangential_scale_(2 * 2 * kCountBuckets * 6, 1),
      normal_scale_(2 * 16, 1),
      refine_({2 * 12, 16}),
      tangential_on_planes_({2 * 6 * kCountBuckets, 9 * 9 * 2, 2 * 16, PlaneModel::kContexts},
                            settings.mixers, true),
      normal_on_planes_({16 * 4, 16 * 6, PlaneModel::kContexts}, settings.mixers, true),
      refine_on_planes_({2 * 12, 16, PlaneModel::kHalfContexts[0], PlaneModel::kHalfContexts[1]}) {
  if (settings.light) light_ = std::make_unique<LightPositionModel>(lo_, hi_);
}

LatticeCoder::~LatticeCoder() = default;

void LatticeCoder::UsePlanes(std::shared_ptr<const CoordinatePlanes> planes) {
  if (light_) light_->UsePlanes(planes);
  plane_model_.Use(std::move(planes));
}

void LatticeCoder::Visit(LearnedStateVisitor& visitor) {
  tangential_.Visit(visitor);
  density_.Visit(visitor);
  normal_.Visit(visitor);
  for (auto& fit : tangential_fit_) fit.Visit(visitor);
  tangential_scale_.Visit(visitor);
  normal_scale_.Visit(visitor);
  refine_.Visit(visitor);
  spokes_.Visit(visitor);
  plane_model_.Visit(visitor);
  tangential_on_planes_.Visit(visitor);
  normal_on_planes_.Visit(visitor);
  refine_on_planes_.Visit(visitor);
}

int32_t LatticeCoder::Centre(uint32_t axis, int32_t cell, uint32_t shift) const {
  int64_t begin = int64_t{cell} << shift;
  int64_t centre = begin + (shift > 0 ? int64_t{1} << (shift - 1) : 0);
  return static_cast<int32_t>(std::clamp<int64_t>(centre, lo_[axis], hi_[axis]));
}

struct LatticeCoder::NewVertex {
  const Int3& old;
  const RingShape& ring;
  uint32_t count, eccentricity;  ///< buckets
  Vector3 ahead;                 ///< where it is expected, relative to the old one
  Vector3 offset{0, 0, 0};       ///< of the coordinates that are coded
  double miss_before = 0, variance_before = 1;

  double inverse() const { return 1 / ring.spacing; }
};

struct LatticeCoder::Coordinate {
  uint32_t step, axis, shift;
  int32_t lo, hi, value;  ///< cells
  double cell, origin;    ///< lattice units; where offset 0 is
};

template <size_t N, class Coder, class Model>
int32_t LatticeCoder::CodeCell(Coder& coder, const NewVertex& vertex, const Coordinate& at,
                               const std::array<uint32_t, N>& contexts,
                               const std::array<CellPrediction, 2>& predictions,
                               const AxisDensity* measured, Model* model,
                               CellModel<N + 1, 2, 1>* on_planes) {
  CellDensity density{measured, at.origin, at.cell};
  spokes_.Begin(at.axis, at.shift, at.lo, int64_t{at.hi} + 1, At(vertex.old, at.axis));
  PlaneWindow window;
  const auto below = [&](int64_t k) {
    const double power =
        detail::LogisticPower(static_cast<double>(k), predictions[0].mean, predictions[0].scale);
    return density.Below(k, power);
  };
  if (plane_model_.Weigh({at.axis, at.shift, at.lo, at.hi, predictions[0].mean,
                          At(vertex.old, at.axis) >> at.shift},
                         below, &window)) {
    density.planes = &window;
    std::array<uint32_t, N + 1> more;
    std::copy(contexts.begin(), contexts.end(), more.begin());
    more[N] = plane_model_.context();
    return on_planes->Code(coder, more, predictions, at.lo, at.hi, at.value, density, spokes_);
  }
  return model->Code(coder, contexts, predictions, at.lo, at.hi, at.value, density, spokes_);
}

/// Along the surface.
template <class Coder>
int32_t LatticeCoder::CodeAlong(Coder& coder, const Coordinate& at, NewVertex* vertex) {
  const RingShape& ring = vertex->ring;
  const uint32_t axis = at.axis, step = at.step, first = (ring.dominant + 1) % 3;
  const double inverse = vertex->inverse();
  double variance = Covariance(ring, axis, axis), slope = 0;
  if (step == 1) {
    slope = Covariance(ring, first, axis) / vertex->variance_before;
    variance = variance - slope * Covariance(ring, first, axis);
  }
  const double floor = 0.02 * ring.spacing * ring.spacing;
  if (!(variance > floor)) variance = floor;
  if (step == 0) vertex->variance_before = variance;
  const double width = std::sqrt(variance), straight = vertex->ahead[axis];
  if (has_density_ && step == 0) density_.First(axis, &axis_density_);
  if (has_density_ && step == 1) {
    density_.Second(axis, first, vertex->offset[first], &axis_density_);
  }
  const double far = straight + slope * vertex->miss_before;
  const double near =
      ring.mean[axis] + (step == 1 ? slope * (vertex->offset[first] - ring.mean[first]) : 0);
  const uint32_t place = (step * kCountBuckets + vertex->count) * 6 + vertex->eccentricity;
  const std::array<double, 2> means{far, near};
  std::array<CellPrediction, 2> predictions;
  for (uint32_t p = 0; p < 2; ++p) {
    const double scale = kScalePerMiss * tangential_scale_.Of(place * 2 + p) * width / at.cell;
    predictions[p] = {(at.origin + means[p]) / at.cell, std::max(scale, 0.05)};
  }
  const uint32_t lean = SideBucket(ring.mean[axis] * inverse);
  const uint32_t side = step == 0 ? 4 : SideBucket(vertex->offset[first] * inverse);
  const std::array<uint32_t, 3> contexts{
      (step * 6 + vertex->eccentricity) * kCountBuckets + vertex->count,
      (lean * 9 + side) * 2 + step, OctaveBucket(width / at.cell) * 2 + step};
  const int32_t value =
      CodeCell(coder, *vertex, at, contexts, predictions, has_density_ ? &axis_density_ : nullptr,
               &tangential_, &tangential_on_planes_);
  const double place_now = static_cast<double>(Centre(axis, value, at.shift)) + 0.5 - at.origin;
  vertex->offset[axis] = place_now;
  for (uint32_t p = 0; p < 2; ++p) {
    tangential_scale_.Learn(place * 2 + p, std::fabs(place_now - means[p]) / width);
  }
  if (step == 0) vertex->miss_before = place_now - straight;
  tangential_fit_[vertex->count].Learn(Features(ring, axis),
                                       std::clamp(place_now * inverse, -64.0, 64.0));
  if (has_density_ && step == 1) density_.Learn(place_now);
  return value;
}

/// Across the surface.
template <class Coder>
int32_t LatticeCoder::CodeAcross(Coder& coder, const Coordinate& at, const NewVertex& vertex) {
  const RingShape& ring = vertex.ring;
  const uint32_t axis = at.axis, i = (axis + 1) % 3, j = (axis + 2) % 3;
  const double steep = std::fabs(ring.normal[axis]);
  const double bent = ring.MeetQuadric(vertex.offset);
  const double flat =
      -(ring.normal[i] * vertex.offset[i] + ring.normal[j] * vertex.offset[j]) / ring.normal[axis];
  const double width = (ring.fit_error + 0.1 * ring.height_range) / steep + 0.25 * at.cell;
  const uint32_t width_bucket = OctaveBucket(width / at.cell);
  const std::array<double, 2> means{bent, flat};
  std::array<CellPrediction, 2> predictions;
  for (uint32_t p = 0; p < 2; ++p) {
    const double scale = kScalePerMiss * normal_scale_.Of(width_bucket * 2 + p) * width / at.cell;
    predictions[p] = {(at.origin + means[p]) / at.cell, std::max(scale, 0.05)};
  }
  const uint32_t tilt = steep < 0.7 ? 0 : (steep < 0.85 ? 1 : (steep < 0.95 ? 2 : 3));
  const std::array<uint32_t, 2> contexts{
      width_bucket * 4 + tilt,
      OctaveBucket(2 * ring.fit_error / at.cell) * 6 + vertex.eccentricity};
  const int32_t value =
      CodeCell(coder, vertex, at, contexts, predictions, nullptr, &normal_, &normal_on_planes_);
  const double place_now = static_cast<double>(Centre(axis, value, at.shift)) + 0.5 - at.origin;
  for (uint32_t p = 0; p < 2; ++p) {
    normal_scale_.Learn(width_bucket * 2 + p, std::fabs(place_now - means[p]) / width);
  }
  return value;
}

template <class Coder>
Int3 LatticeCoder::CodeNew(Coder& coder, const Int3& old, const LightRing& ring,
                           LatticePrecision precision, const Int3& truth,
                           uint64_t* tangential_meter, uint64_t* normal_meter) {
  Shifts shifts;
  std::array<int32_t, 3> cells;
  for (uint32_t axis = 0; axis < 3; ++axis) {
    const uint32_t shift = axis == ring.axes[2] ? precision.normal : precision.tangential;
    shifts[axis] = static_cast<uint8_t>(shift);
    cells[axis] = At(truth, axis) >> shift;
  }
  cells = light_->Code(coder, old, ring, shifts, cells, tangential_meter, normal_meter);
  Int3 result;
  for (uint32_t axis = 0; axis < 3; ++axis) {
    At(result, axis) = Centre(axis, cells[axis], shifts[axis]);
  }
  shifts_.push_back(shifts);
  return result;
}

template <class Coder>
Int3 LatticeCoder::CodeNew(Coder& coder, const Int3& old, const RingShape& ring,
                           LatticePrecision precision, const Int3& truth,
                           uint64_t* tangential_meter, uint64_t* normal_meter) {
  Int3 result;
  Shifts shifts;
  NewVertex vertex{old, ring, CountBucket(ring), EccentricityBucket(ring), {}};
  for (uint32_t axis = 0; axis < 3; ++axis) {
    vertex.ahead[axis] = tangential_fit_[vertex.count].Predict(Features(ring, axis)) * ring.spacing;
  }
  if (has_density_) density_.Prepare(ring, vertex.ahead);
  plane_model_.Start();
  spokes_.Start(ring);
  for (uint32_t step = 0; step < 3; ++step) {
    coder.SetMeter(step < 2 ? tangential_meter : normal_meter);
    const uint32_t axis = (ring.dominant + 1 + step) % 3;
    const uint32_t shift = step < 2 ? precision.tangential : precision.normal;
    shifts[axis] = static_cast<uint8_t>(shift);
    const Coordinate at{step,
                        axis,
                        shift,
                        lo_[axis] >> shift,
                        hi_[axis] >> shift,
                        At(truth, axis) >> shift,
                        static_cast<double>(uint64_t{1} << shift),
                        static_cast<double>(At(old, axis)) + 0.5};
    const int32_t value = step < 2 ? CodeAlong(coder, at, &vertex) : CodeAcross(coder, at, vertex);
    plane_model_.Learn(value);
    spokes_.End();
    At(result, axis) = Centre(axis, value, shift);
  }
  shifts_.push_back(shifts);
  return result;
}

template <class Coder>
bool LatticeCoder::CodeHalf(Coder& coder, uint32_t axis, uint32_t lean_context, const Int3& known,
                            const Shifts& shifts, bool upper) {
  const uint32_t size = std::min<uint32_t>(shifts[axis], 15);
  const std::array<int32_t, 3> cells{known.x >> shifts[0], known.y >> shifts[1],
                                     known.z >> shifts[2]};
  const PlaneModel::HalfSigns signs = plane_model_.SignsOf(axis, cells, shifts);
  if (!signs.tells) return refine_.Code(coder, {lean_context, size}, 0, upper);
  return refine_on_planes_.Code(coder, {lean_context, size, signs.contexts[0], signs.contexts[1]},
                                0, upper);
}

template <class Coder>
Int3 LatticeCoder::Refine(Coder& coder, uint32_t vertex, const Int3& known, const RingPlane& ring,
                          LatticePrecision precision, const Int3& truth) {
  Int3 result = known;
  Shifts& shifts = shifts_[vertex];
  for (uint32_t axis = 0; axis < 3; ++axis) {
    bool is_normal = axis == ring.dominant;
    uint32_t target = is_normal ? precision.normal : precision.tangential;
    while (shifts[axis] > target) {
      uint32_t shift = shifts[axis];
      int32_t cell = At(result, axis) >> shift;
      double size = static_cast<double>(uint64_t{1} << shift);
      double lean =
          (is_normal ? Dot(ring.mean, ring.normal) / ring.normal[axis] : ring.mean[axis]) / size;
      constexpr std::array<double, 10> kBounds{-8, -4, -2, -1, -0.3, 0.3, 1, 2, 4, 8};
      uint32_t context = (is_normal ? 12u : 0u) + Bucket(lean, kBounds);
      bool upper = false;
      if constexpr (Coder::kEncoding) upper = (At(truth, axis) >> (shift - 1) & 1) != 0;
      int32_t first = static_cast<int32_t>(int64_t{cell} << 1);
      // A half outside the box is impossible.
      if (int64_t{first + 1} << (shift - 1) > hi_[axis]) {
        upper = false;
      } else {
        upper = CodeHalf(coder, axis, context, result, shifts, upper);
      }
      shifts[axis] = static_cast<uint8_t>(shift - 1);
      At(result, axis) = Centre(axis, first + (upper ? 1 : 0), shift - 1);
    }
  }
  return result;
}

#define FOLPROM_INSTANTIATE(Coder)                                                                 \
  template Int3 LatticeCoder::CodeNew<Coder>(Coder&, const Int3&, const RingShape&,                \
                                             LatticePrecision, const Int3&, uint64_t*, uint64_t*); \
  template Int3 LatticeCoder::CodeNew<Coder>(Coder&, const Int3&, const LightRing&,                \
                                             LatticePrecision, const Int3&, uint64_t*, uint64_t*); \
  template Int3 LatticeCoder::Refine<Coder>(Coder&, uint32_t, const Int3&, const RingPlane&,       \
                                            LatticePrecision, const Int3&);
FOLPROM_INSTANTIATE(BitEncoder)
FOLPROM_INSTANTIATE(BitDecoder)
#undef FOLPROM_INSTANTIATE

}  // namespace folprom
