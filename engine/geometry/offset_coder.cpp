#include "engine/geometry/offset_coder.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/entropy/bit_coder.h"
#include "engine/entropy/fixed_math.h"

namespace folprom {
namespace {

constexpr uint32_t kMostChildren = 8;
constexpr uint32_t kSizeBuckets = 8;
constexpr uint32_t kSpacingBuckets = 128;

uint32_t SizeBucket(uint64_t value) {
  uint32_t width = static_cast<uint32_t>(std::bit_width(value));
  return width < kSizeBuckets ? width : kSizeBuckets - 1;
}

/// Child i of m as one number, for all m up to `children`.
uint32_t Place(uint32_t count, uint32_t child) { return count * (count - 1) / 2 + child; }
uint32_t Places(uint32_t children) { return Place(children + 1, 0); }

/// Height range over distance range: 0 flat .. 5 steep.
uint32_t SteepnessBucket(const Neighbourhood& at) {
  double ratio = at.range_rho > 0 ? at.range_z / at.range_rho : 1;
  constexpr double kBounds[5] = {0.05, 0.12, 0.25, 0.5, 1.0};
  uint32_t bucket = 0;
  while (bucket < 5 && ratio >= kBounds[bucket]) ++bucket;
  return bucket;
}

/// Mean neighbour height in steps: 0 far below .. 6 far above.
uint32_t HollowBucket(const Neighbourhood& at, double step) {
  double ratio = step > 0 ? at.mean_z / step : 0;
  constexpr double kBounds[6] = {-8, -4, -1.5, 1.5, 4, 8};
  uint32_t bucket = 0;
  while (bucket < 6 && ratio >= kBounds[bucket]) ++bucket;
  return bucket;
}

/// Distance of the neighbours in steps, in half octaves.
constexpr uint32_t kReachBuckets = 16;
uint32_t ReachBucket(double steps) {
  int bucket = HalfOctave(static_cast<uint64_t>(std::min(4 * steps, 1e9))) - 2;
  return static_cast<uint32_t>(std::clamp(bucket, 0, static_cast<int>(kReachBuckets) - 1));
}

/// A signed index as OffsetIndex holds it, and back.
constexpr uint32_t kZero = uint32_t{1} << 31;
uint32_t Raised(int32_t value) { return static_cast<uint32_t>(value) + kZero; }
int32_t Lowered(uint32_t value) { return static_cast<int32_t>(value - kZero); }

/// Size and sign: 0 .. 2 * kSizeBuckets - 2.
constexpr uint32_t kSignedBuckets = 2 * kSizeBuckets - 1;
uint32_t SignedBucket(int32_t value) {
  if (value >= 0) return SizeBucket(static_cast<uint64_t>(value));
  return kSizeBuckets - 1 + SizeBucket(static_cast<uint64_t>(-int64_t{value}));
}

/// Nearest integer of a value that may be anything, kept where 30 bits hold it.
int32_t RoundToInt(double value) {
  double rounded = std::floor(value + 0.5);
  constexpr double kLimit = 1 << 30;
  if (!(rounded > -kLimit)) return -(1 << 30);
  return rounded < kLimit ? static_cast<int32_t>(rounded) : 1 << 30;
}

/// Contexts of a model that is needed only where `used`.
std::array<uint32_t, 2> Where(bool used, std::array<uint32_t, 2> contexts) {
  return used ? contexts : std::array<uint32_t, 2>{0, 0};
}

}  // namespace

OffsetCoder::OffsetCoder(const OffsetSettings& settings)
    : settings_(settings),
      is_full_({kSpacingBuckets, 4 * 4}),
      fewer_({kMostChildren}),
      first_theta_(Where(!settings.cartesian, {settings.children + 1, settings.children})),
      theta_(Where(!settings.cartesian,
                   {Places(settings.children), kSizeBuckets * settings.children})),
      rho_(Where(!settings.cartesian,
                 {Places(settings.children) * kReachBuckets, kSizeBuckets * 6})),
      x_(Where(settings.cartesian,
               {Places(settings.children) * kSignedBuckets, kSignedBuckets * 6})),
      y_(Where(settings.cartesian,
               {Places(settings.children) * kSignedBuckets, kSignedBuckets * kSignedBuckets})),
      z_({7 * 5 * settings.children, kSizeBuckets * 6}),
      half_({3 * 16}) {}

OffsetSteps OffsetCoder::StepsFor(const Neighbourhood& at, double least) const {
  double levels = settings_.levels;
  OffsetSteps steps;
  steps.theta = 2 * kPi / levels;
  // x and y reach as far to both sides.
  double rho = at.range_rho * (settings_.cartesian ? 2 : 1) / levels, z = at.range_z / levels;
  if (!settings_.adaptive) rho = z = std::max(rho, z);
  steps.rho = std::max(rho, least);
  steps.z = std::max(z, least);
  if (settings_.cartesian) steps.theta = steps.rho;
  return steps;
}

OffsetIndex OffsetCoder::Quantise(const Neighbourhood& at, const OffsetSteps& steps,
                                  const Int3& point) const {
  LocalFrame frame = at.frame;
  frame.cartesian = settings_.cartesian;
  CylinderPoint local = ToCylinder(frame, point);
  OffsetIndex index;
  index.z = RoundToInt(local.z / steps.z);
  if (settings_.cartesian) {
    index.theta = Raised(RoundToInt(local.rho / steps.rho));
    index.rho = Raised(RoundToInt(local.theta / steps.theta));
    return index;
  }
  uint32_t theta = static_cast<uint32_t>(RoundToInt(local.theta / steps.theta));
  index.theta = theta >= settings_.levels ? 0 : theta;
  index.rho = static_cast<uint32_t>(RoundToInt(std::floor(local.rho / steps.rho)));
  return index;
}

CylinderCell OffsetCoder::CellOf(const Neighbourhood& at, const OffsetSteps& steps,
                                 const OffsetIndex& index) const {
  CylinderCell cell;
  cell.frame = at.frame;
  cell.frame.cartesian = settings_.cartesian;
  cell.width = {steps.rho, steps.theta, steps.z};
  if (settings_.cartesian) {
    cell.centre = {Lowered(index.theta) * steps.rho, Lowered(index.rho) * steps.theta,
                   static_cast<double>(index.z) * steps.z};
    return cell;
  }
  cell.centre = {(static_cast<double>(index.rho) + 0.5) * steps.rho,
                 static_cast<double>(index.theta) * steps.theta,
                 static_cast<double>(index.z) * steps.z};
  return cell;
}

template <class Coder>
uint32_t OffsetCoder::CodeChildCount(Coder& coder, const SetContext& context, uint32_t count) {
  double squared = context.spacing * context.spacing;
  int bucket = HalfOctave(static_cast<uint64_t>(std::min(squared, 9e18)));
  uint32_t spacing =
      static_cast<uint32_t>(std::clamp(bucket, 0, static_cast<int>(kSpacingBuckets) - 1));
  uint32_t around =
      std::min(context.leaf_neighbours, 3u) * 4 + std::min(context.other_neighbours, 3u);
  uint32_t most = settings_.children;
  if (most == 2 || is_full_.Code(coder, {spacing, around}, 0, count == most)) return most;
  // m < K: the set holds m vertices; the larger the rarer.
  for (uint32_t smaller = 2; smaller < most - 1; ++smaller) {
    if (!fewer_.Code(coder, {smaller}, 0, count > smaller)) return smaller;
  }
  return most - 1;
}

template <class Coder>
uint32_t OffsetCoder::CodeTheta(Coder& coder, const Siblings& siblings, uint32_t i,
                                const std::vector<OffsetIndex>& offsets, OffsetMeters* meters) {
  coder.SetMeter(&meters->theta);
  const uint32_t levels = settings_.levels, index = offsets[i].theta;
  const bool first = i == 0;
  if (first || !settings_.predict_theta) {
    if (meters->tally) meters->tally->theta.Add(index, first ? 0 : 1);
    return first_theta_.CodeUnsigned(coder, {siblings.count, i}, index);
  }
  // The angles still to come are spread evenly over what is left of the turn.
  int32_t before = static_cast<int32_t>(offsets[i - 1].theta);
  int32_t left = static_cast<int32_t>(levels + offsets[0].theta) - before;
  int32_t predicted = std::min(before + left / static_cast<int32_t>(siblings.count - i + 1),
                               static_cast<int32_t>(levels) - 1);
  int32_t residual = static_cast<int32_t>(index) - predicted;
  if (meters->tally) meters->tally->theta.Add(residual, 1);
  residual = theta_.CodeSigned(
      coder, {Place(siblings.count, i), SizeBucket(siblings.rho_before) * settings_.children + i},
      residual);
  return static_cast<uint32_t>(
      std::clamp<int64_t>(int64_t{predicted} + residual, 0, static_cast<int64_t>(levels) - 1));
}

template <class Coder>
uint32_t OffsetCoder::CodeRho(Coder& coder, const Siblings& siblings, uint32_t i, double expected,
                              uint32_t index, OffsetMeters* meters) {
  coder.SetMeter(&meters->rho);
  if (meters->tally) meters->tally->rho.Add(index);
  uint32_t reach = ReachBucket(expected / siblings.steps.rho);
  return rho_.CodeUnsigned(coder,
                           {Place(siblings.count, i) * kReachBuckets + reach,
                            SizeBucket(siblings.rho_before) * 6 + siblings.steep},
                           index);
}

template <class Coder>
OffsetIndex OffsetCoder::CodePlane(Coder& coder, const Siblings& siblings, uint32_t i,
                                   const std::vector<OffsetIndex>& offsets, OffsetMeters* meters) {
  OffsetIndex index = offsets[i];
  int32_t x = Lowered(index.theta), y = Lowered(index.rho);
  const uint32_t place = Place(siblings.count, i) * kSignedBuckets;
  const uint32_t x_before = i > 0 ? SignedBucket(Lowered(offsets[i - 1].theta)) : 0;
  const uint32_t y_before = i > 0 ? SignedBucket(Lowered(offsets[i - 1].rho)) : 0;
  if (meters->tally) {
    meters->tally->theta.Add(x, i == 0 ? 0 : 1);
    meters->tally->rho.Add(y);
  }
  coder.SetMeter(&meters->theta);
  x = x_.CodeSigned(coder, {place + x_before, y_before * 6 + siblings.steep}, x);
  coder.SetMeter(&meters->rho);
  const uint32_t x_bucket = SignedBucket(x);
  y = y_.CodeSigned(coder, {place + x_bucket, y_before * kSignedBuckets + x_bucket}, y);
  index.theta = Raised(x);
  index.rho = Raised(y);
  return index;
}

template <class Coder>
int32_t OffsetCoder::CodeHeight(Coder& coder, Siblings& siblings, uint32_t i, double rho,
                                double bend, int32_t index, OffsetMeters* meters) {
  coder.SetMeter(&meters->z);
  const double step = siblings.steps.z;
  // On a surface bent as the neighbours say the height grows with the square of the distance.
  // It is kept to the heights seen: beside a neighbour on the axis the bend has no bound.
  // Without the prediction heights count from the lowest neighbour instead of the parent.
  double highest = siblings.at.range_z / step;
  int32_t predicted = settings_.predict_height
                          ? RoundToInt(std::clamp(bend * rho * rho / step, -highest, highest))
                          : RoundToInt(siblings.at.min_z / step);
  uint32_t bucket = std::min(
      SizeBucket(static_cast<uint64_t>(predicted < 0 ? -int64_t{predicted} : predicted)), 4u);
  int32_t residual = RoundToInt(static_cast<double>(index) - predicted);
  if (meters->tally) meters->tally->z.Add(residual);
  residual = z_.CodeSigned(coder,
                           {(siblings.hollow * 5 + bucket) * settings_.children + i,
                            SizeBucket(siblings.z_before) * 6 + siblings.steep},
                           residual);
  siblings.z_before = static_cast<uint32_t>(residual < 0 ? -residual : residual);
  return RoundToInt(static_cast<double>(residual) + predicted);
}

template <class Coder>
void OffsetCoder::CodeOffsets(Coder& coder, const Neighbourhood& at, const OffsetSteps& steps,
                              uint32_t count, std::vector<OffsetIndex>* offsets,
                              OffsetMeters* meters) {
  offsets->resize(count);
  Siblings siblings{at, steps, count, SteepnessBucket(at), HollowBucket(at, steps.z)};
  for (uint32_t i = 0; i < count; ++i) {
    OffsetIndex& index = (*offsets)[i];
    if (settings_.cartesian) {
      index = CodePlane(coder, siblings, i, *offsets, meters);
      const double x = Lowered(index.theta) * steps.rho, y = Lowered(index.rho) * steps.theta;
      const double rho = std::sqrt(x * x + y * y);
      const double bend = rho > 0 ? at.Towards(x / rho, y / rho).bend : 0;
      index.z = CodeHeight(coder, siblings, i, rho, bend, index.z, meters);
      continue;
    }
    index.theta = CodeTheta(coder, siblings, i, *offsets, meters);
    if (index.theta >= settings_.levels) {
      throw Failure(ErrorKind::kCorrupt, "coded angle out of range");
    }
    double sine, cosine;
    SinCos(index.theta * steps.theta, &sine, &cosine);
    Neighbourhood::Outlook outlook = at.Towards(cosine, sine);
    index.rho = CodeRho(coder, siblings, i, outlook.rho, index.rho, meters);
    siblings.rho_before = index.rho;
    index.z = CodeHeight(coder, siblings, i, (index.rho + 0.5) * steps.rho, outlook.bend, index.z,
                         meters);
  }
}

template <class Coder>
bool OffsetCoder::CodeHalf(Coder& coder, const CylinderCell& cell,
                           CylinderCell::Dimension dimension, bool upper) {
  // Near the axis the outer half of a ring is larger: how many widths out is worth a context.
  bool curved = !cell.frame.cartesian && cell.width.rho > 0;
  double rings = curved ? cell.centre.rho / cell.width.rho : 0;
  uint32_t ring = static_cast<uint32_t>(std::min(rings, 15.0));
  return half_.Code(coder, {static_cast<uint32_t>(dimension) * 16 + ring}, 0, upper);
}

#define FOLPROM_INSTANTIATE(Coder)                                                                 \
  template uint32_t OffsetCoder::CodeChildCount<Coder>(Coder&, const SetContext&, uint32_t);       \
  template void OffsetCoder::CodeOffsets<Coder>(Coder&, const Neighbourhood&, const OffsetSteps&,  \
                                                uint32_t, std::vector<OffsetIndex>*,               \
                                                OffsetMeters*);                                    \
  template bool OffsetCoder::CodeHalf<Coder>(Coder&, const CylinderCell&, CylinderCell::Dimension, \
                                             bool);
FOLPROM_INSTANTIATE(BitEncoder)
FOLPROM_INSTANTIATE(BitDecoder)
#undef FOLPROM_INSTANTIATE

}  // namespace folprom
