#include "apps/folprom/synth_part.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "apps/folprom/synth_noise.h"

namespace folprom::cli {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kBlobBottom = 0.06;  // part of the way from pole to pole that is open
constexpr float kShift = 2;           // moves the unit shape to positive coordinates

// Relief: octaves from the shape as a whole down to details that do not depend on the sampling.
struct Octave {
  float frequency;
  float height;
};
constexpr Octave kCoarse[] = {{1.3f, 0.26f}, {2.9f, 0.12f}};  // holes lie in its hollows
constexpr Octave kDetail[] = {{6.1f, 0.05f}, {13.3f, 0.022f}, {29.7f, 0.01f}};

// The finest relief, the small holes and the noise go with the spacing of the samples.
constexpr double kFineSize = 12;     // samples
constexpr float kFineHeight = 0.5f;  // spacings
constexpr float kNoiseHeight = 0.08f;
constexpr float kHollowDepth = -0.185f;
constexpr float kFineHole = 0.72f;
constexpr uint64_t kSpotsPerMillion = 400;  // single samples that the scanner lost

// Rows differ in their number of samples by up to half of this, so that they do not form a grid.
constexpr double kCountSpread = 0.14;
constexpr double kLean = 1.2;  // spacings between the middles of two edges that pass as equal

constexpr double kUnitOf16Bits = 1.0 / 65536;

double SixteenBits(uint64_t hash, int which) {
  return static_cast<double>((hash >> (16 * which)) & 0xFFFF) * kUnitOf16Bits;
}

}  // namespace

Part::Part(PartShape shape, uint64_t samples, std::array<double, 3> centre, double size,
           uint64_t seed)
    : shape_(shape), samples_(samples), centre_(centre), size_(size), seed_(Mix(seed)) {
  const double area = shape == PartShape::kBlob ? 4 * kPi : 4;
  spacing_ = std::sqrt(area / static_cast<double>(samples));
  const double height = shape == PartShape::kBlob ? kPi * (1 - kBlobBottom) : 2;
  rows_ = std::max<uint64_t>(2, static_cast<uint64_t>(height / spacing_ + 0.5));
  if (shape == PartShape::kSheet) rows_ = std::min(rows_, samples / 2);
}

// Random in [-1/2, 1/2] times the spread.
double Part::CountDeviation(uint64_t row) const {
  return kCountSpread * (SixteenBits(Mix(seed_ + row), 0) - 0.5);
}

uint64_t Part::SamplesInRow(uint64_t row) const {
  const auto rounded = [&](double count) {
    return static_cast<uint64_t>(count * (1 + CountDeviation(row)) + 0.5);
  };
  switch (shape_) {
    case PartShape::kBlob: {
      if (row + 1 == rows_) return 1;  // the pole
      const double v = kBlobBottom + (1 - kBlobBottom) * static_cast<double>(row) /
                                         static_cast<double>(rows_ - 1);
      return std::max<uint64_t>(5, rounded(2 * kPi * SinTurns(v / 2) / spacing_));
    }
    case PartShape::kPatch:
      return std::max<uint64_t>(2, rounded(2 / spacing_));
    case PartShape::kSheet:
      break;
  }
  // An exact sum: even shares, and what a row deviates goes to the next. Truncation leaves rows of
  // a few samples as they are. Products of up to 2^36 by 2^18 stay in 64 bits.
  const auto up_to = [&](uint64_t rows) {
    const bool end = rows == 0 || rows == rows_;
    const double share = static_cast<double>(samples_) / static_cast<double>(rows_);
    const auto deviation = end ? 0 : static_cast<int64_t>(CountDeviation(rows) * share);
    return rows * samples_ / rows_ + static_cast<uint64_t>(deviation);
  };
  return up_to(row + 1) - up_to(row);
}

void Part::FillRow(uint64_t row, bool with_positions, SampleRow* out) const {
  PlaceSamples(row, out);
  HideSamples(out);
  if (with_positions) RaiseSamples(out);
}

// Jittered along and across the row; denser where the sine warp says so.
void Part::PlaceSamples(uint64_t row, SampleRow* out) const {
  const uint64_t count = SamplesInRow(row);
  const bool pole = shape_ == PartShape::kBlob && count == 1;
  Scratch& s = scratch_;
  out->u.resize(count);
  out->lean.resize(count);
  out->present.resize(count);
  for (auto* values :
       {&s.x, &s.y, &s.z, &s.noise_x, &s.noise_y, &s.noise_z, &s.coarse, &s.fine, &s.jitter}) {
    values->resize(count);
  }

  const uint64_t row_seed = Mix(seed_ ^ (row * 0xD1B54A32D192ED03u));
  const double row_height = 1.0 / static_cast<double>(rows_ > 1 ? rows_ - 1 : 1);
  // A ring may turn its dense side from row to row; the ends of a sheet's row must stay.
  const double dense_side = ring() ? static_cast<double>(row) * row_height * 0.8 : 0;
  for (uint64_t i = 0; i < count; ++i) {
    const uint64_t hash = Mix(row_seed + i);
    const double cell = static_cast<double>(i) + 0.05 + 0.9 * SixteenBits(hash, 0);
    const double even = cell / static_cast<double>(count);
    out->u[i] = even + 0.45 / (2 * kPi) * SinTurns(even + dense_side);
    const double across = pole ? 0 : 0.6 * (SixteenBits(hash, 1) - 0.5);
    const double v = (static_cast<double>(row) + across) * row_height;
    // Sum of two: most errors are small.
    s.jitter[i] = static_cast<float>(SixteenBits(hash, 2) + SixteenBits(hash, 3) - 1);
    const uint64_t second_hash = Mix(hash);
    const bool lost = second_hash % 1000000 < kSpotsPerMillion;
    out->lean[i] = kLean * (SixteenBits(second_hash, 3) - 0.5) / static_cast<double>(count);
    out->present[i] = shape_ == PartShape::kSheet || !lost;
    if (shape_ == PartShape::kBlob) {
      const double latitude = (kBlobBottom + (1 - kBlobBottom) * v) / 2;
      const double radius = SinTurns(latitude);
      s.x[i] = static_cast<float>(radius * CosTurns(out->u[i]));
      s.y[i] = static_cast<float>(radius * SinTurns(out->u[i]));
      s.z[i] = static_cast<float>(-CosTurns(latitude));
    } else {
      s.x[i] = static_cast<float>(2 * out->u[i] - 1);
      s.y[i] = static_cast<float>(2 * v - 1);
      s.z[i] = 0;
    }
  }
}

// Adds an octave of noise to *sum.
void Part::AddNoise(uint64_t octave, float frequency, float height, std::vector<float>* sum) const {
  const auto seed = static_cast<uint32_t>(Mix(seed_ + octave) >> 32);
  const Scratch& s = scratch_;
  for (size_t i = 0; i < sum->size(); ++i) {
    (*sum)[i] += height * ValueNoise(s.noise_x[i] * frequency, s.noise_y[i] * frequency,
                                     s.noise_z[i] * frequency, seed);
  }
}

// Holes: deep hollows, which a scanner does not see into, and small ones all over.
void Part::HideSamples(SampleRow* out) const {
  Scratch& s = scratch_;
  const size_t count = s.x.size();
  for (size_t i = 0; i < count; ++i) {
    // Turned, so that the lattice of the noise does not show on flat sheets.
    const float turned_y = 0.6f * s.x[i] + 0.8f * s.y[i];
    s.noise_x[i] = kShift + 0.8f * s.x[i] - 0.6f * s.y[i];
    s.noise_y[i] = kShift + 0.8f * turned_y - 0.6f * s.z[i];
    s.noise_z[i] = kShift + 0.6f * turned_y + 0.8f * s.z[i];
  }
  std::fill(s.coarse.begin(), s.coarse.end(), 0.0f);
  std::fill(s.fine.begin(), s.fine.end(), 0.0f);
  for (size_t o = 0; o < std::size(kCoarse); ++o) {
    AddNoise(o, kCoarse[o].frequency, kCoarse[o].height, &s.coarse);
  }
  AddNoise(100, static_cast<float>(1 / (kFineSize * spacing_)), 1, &s.fine);
  if (shape_ == PartShape::kSheet) return;
  const bool outline = shape_ == PartShape::kPatch;
  for (size_t i = 0; i < count; ++i) {
    const float rim = outline ? s.x[i] * s.x[i] + s.y[i] * s.y[i] + s.coarse[i] : 0.0f;
    const bool hidden =
        s.coarse[i] + 0.02f * s.fine[i] < kHollowDepth || s.fine[i] > kFineHole || rim > 0.95f;
    out->present[i] = out->present[i] != 0 && !hidden;
  }
}

// Moves the samples off the unit shape by relief and noise, then to model units.
void Part::RaiseSamples(SampleRow* out) const {
  Scratch& s = scratch_;
  const size_t count = s.x.size();
  const auto spacing = static_cast<float>(spacing_);
  for (size_t i = 0; i < count; ++i) {
    s.coarse[i] += spacing * (kFineHeight * s.fine[i] + kNoiseHeight * s.jitter[i]);
  }
  for (size_t o = 0; o < std::size(kDetail); ++o) {
    AddNoise(200 + o, kDetail[o].frequency, kDetail[o].height, &s.coarse);
  }
  out->xyz.resize(3 * count);
  const bool blob = shape_ == PartShape::kBlob;
  for (size_t i = 0; i < count; ++i) {
    const double h = static_cast<double>(s.coarse[i]);
    const double x = static_cast<double>(s.x[i]);
    const double y = static_cast<double>(s.y[i]);
    const double z = static_cast<double>(s.z[i]);
    const double stretch = blob ? 1 + h : 1;
    out->xyz[3 * i + 0] = centre_[0] + size_ * x * stretch;
    out->xyz[3 * i + 1] = centre_[1] + size_ * y * stretch;
    out->xyz[3 * i + 2] = centre_[2] + size_ * (blob ? 1.3 * z * stretch : h);
  }
}

}  // namespace folprom::cli
