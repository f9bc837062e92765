#include "apps/folprom/synth_range.h"

#include <algorithm>
#include <cmath>

#include "apps/folprom/synth_noise.h"

namespace folprom::cli {
namespace {

using Point = std::array<double, 3>;

constexpr double kUnit = 100;         // model units of the object's radius
constexpr double kEyeDistance = 4.5;  // from the middle of the object
constexpr double kReach = 1.75;       // nothing of the object lies farther from its middle
constexpr double kSeenArea = 4;       // about what a camera sees of the object, across its view

/// A body of the object: a ball with relief. Small ones hide parts of the large one.
struct Body {
  Point centre;
  double radius;
};
constexpr Body kBodies[] = {{{0, 0, 0}, 1.05},
                            {{1.2, 0.35, 0.3}, 0.28},
                            {{-0.75, 1.05, -0.3}, 0.24},
                            {{-0.3, -1.25, 0.4}, 0.3}};

struct Octave {
  float frequency;
  float height;
};
constexpr Octave kCoarse[] = {{1.3f, 0.13f}, {2.9f, 0.05f}};
constexpr Octave kDetail[] = {{8.3f, 0.012f}, {21.7f, 0.004f}};
constexpr double kMostRelief = 0.2;
constexpr double kDetailMargin = 0.01;
constexpr float kShift = 4;  // moves all places to where noise is defined

constexpr double kNoise = 0.2;              // most depth noise, spacings of samples
constexpr double kMostJump = 4;             // of the depth inside a triangle, spacings
constexpr float kHoleSize = 14;             // pixels
constexpr float kHole = 0.74f;              // noise above it is a hole
constexpr uint64_t kSpotsPerMillion = 400;  // single pixels that the sensor lost

double Dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

float Relief(const Point& at, bool detailed, uint32_t seed) {
  const float x = kShift + static_cast<float>(0.8 * at[0] - 0.6 * at[1]);
  const float y = kShift + static_cast<float>(0.6 * at[0] + 0.8 * at[1]);
  const float z = kShift + static_cast<float>(at[2]);
  float sum = 0;
  const auto add = [&](const Octave& o) {
    sum += o.height * ValueNoise(x * o.frequency, y * o.frequency, z * o.frequency, seed);
    ++seed;
  };
  for (const Octave& octave : kCoarse) add(octave);
  if (detailed) {
    for (const Octave& octave : kDetail) add(octave);
  }
  return sum;
}

/// Sum of two: most errors are small. In [-1, 1].
double SensorNoise(uint64_t hash) {
  constexpr double kUnitOf16Bits = 1.0 / 65536;
  return static_cast<double>((hash & 0xFFFF) + (hash >> 16 & 0xFFFF)) * kUnitOf16Bits - 1;
}

void StartRow(uint64_t count, bool with_positions, SampleRow* out) {
  out->u.resize(count);
  for (uint64_t i = 0; i < count; ++i) out->u[i] = static_cast<double>(i);
  out->lean.assign(count, 0);  // so that all cells share a diagonal
  out->present.assign(count, 0);
  out->depth.assign(count, 0);
  out->xyz.assign(with_positions ? 3 * count : 0, 0);
}

}  // namespace

RangeView::RangeView(double pitch, double turn, double rise, uint64_t object_seed, uint64_t seed)
    : pitch_(pitch),
      side_(std::max<uint64_t>(2, static_cast<uint64_t>(2 * kReach / pitch))),
      seed_(Mix(seed)),
      noise_seed_(static_cast<uint32_t>(Mix(object_seed) >> 32)) {
  const double level = CosTurns(rise), height = SinTurns(rise);
  const double c = CosTurns(turn), s = SinTurns(turn);
  ahead_ = {-level * c, -level * s, -height};
  right_ = {-s, c, 0};
  up_ = {-height * c, -height * s, level};
  for (size_t i = 0; i < 3; ++i) eye_[i] = -kEyeDistance * ahead_[i];
}

double RangeView::PixelsSeen(double pitch) { return kSeenArea / (pitch * pitch); }

// No part of the object is nearer than about this: relief is steep, so half of what is left.
double RangeView::DistanceBound(const Point& p, bool detailed) const {
  double least = 1e9;
  for (const Body& body : kBodies) {
    const Point d{p[0] - body.centre[0], p[1] - body.centre[1], p[2] - body.centre[2]};
    const double length = std::sqrt(Dot(d, d));
    const double outer = length - body.radius * (1 + kMostRelief);
    if (outer > 0.1) {
      least = std::min(least, outer);
      continue;
    }
    const double scale = 1 / std::max(length, 1e-9);
    const Point on{d[0] * scale + body.centre[0], d[1] * scale + body.centre[1],
                   d[2] * scale + body.centre[2]};
    const double radius =
        body.radius * (1 + static_cast<double>(Relief(on, detailed, noise_seed_)));
    least = std::min(least, 0.5 * (length - radius));
  }
  return least;
}

// Walks along the ray from where it may first meet the object. depth: in units of the ray.
bool RangeView::MeetObject(const Point& ray, double* depth) const {
  const double squared = Dot(ray, ray), along = -Dot(eye_, ray);
  const double inside = along * along - squared * (Dot(eye_, eye_) - kReach * kReach);
  if (!(inside > 0)) return false;
  const double half = std::sqrt(inside), length = std::sqrt(squared);
  const double last = (along + half) / squared;
  double t = (along - half) / squared;
  bool detailed = false;
  constexpr int kMostSteps = 200;
  for (int step = 0; step < kMostSteps && t < last; ++step) {
    const Point p{eye_[0] + t * ray[0], eye_[1] + t * ray[1], eye_[2] + t * ray[2]};
    const double bound = DistanceBound(p, detailed);
    if (detailed && bound < 0.01 * pitch_) {
      *depth = t;
      return true;
    }
    // The first steps leave the details out, which are less high than kDetailMargin.
    if (detailed) {
      t += bound / length;
    } else if (bound > 2 * kDetailMargin) {
      t += (bound - kDetailMargin) / length;
    } else {
      detailed = true;
    }
  }
  return false;
}

void RangeView::FillRow(uint64_t row, bool with_positions, SampleRow* out) const {
  StartRow(side_, with_positions, out);
  out->most_jump = kMostJump * pitch_ * kEyeDistance / (kEyeDistance - 1);
  const double middle = 0.5 * static_cast<double>(side_ - 1);
  const double y = (static_cast<double>(row) - middle) * pitch_;
  const auto hole_seed = static_cast<uint32_t>(seed_);
  for (uint64_t i = 0; i < side_; ++i) {
    const uint64_t hash = Mix(seed_ + row * side_ + i);
    const float hole = ValueNoise(static_cast<float>(i) / kHoleSize,
                                  static_cast<float>(row) / kHoleSize, 0.5f, hole_seed);
    if (hole > kHole || (hash >> 32) % 1000000 < kSpotsPerMillion) continue;
    const double x = (static_cast<double>(i) - middle) * pitch_;
    Point ray;
    for (size_t k = 0; k < 3; ++k) {
      ray[k] = kEyeDistance * ahead_[k] + x * right_[k] + y * up_[k];
    }
    double t = 0;
    if (!MeetObject(ray, &t)) continue;
    out->present[i] = 1;
    out->depth[i] = t * kEyeDistance;
    if (!with_positions) continue;
    t += t * pitch_ * kNoise * SensorNoise(hash) / kEyeDistance;
    for (size_t k = 0; k < 3; ++k) out->xyz[3 * i + k] = kUnit * (eye_[k] + t * ray[k]);
  }
}

RangeBoard::RangeBoard(uint64_t samples, double pitch, uint64_t seed)
    : samples_(samples),
      columns_(
          std::max<uint64_t>(2, static_cast<uint64_t>(std::sqrt(static_cast<double>(samples))))),
      pitch_(pitch),
      seed_(Mix(seed)) {}

void RangeBoard::FillRow(uint64_t row, bool with_positions, SampleRow* out) const {
  StartRow(columns_, with_positions, out);
  out->most_jump = 1;
  const uint64_t count = std::min(columns_, samples_ - row * columns_);
  const double middle = 0.5 * static_cast<double>(columns_ - 1);
  const double y = (static_cast<double>(row) - middle) * pitch_;
  // The last row may be short: its samples are those that the shared diagonal gives a triangle.
  for (uint64_t i = columns_ - count; i < columns_; ++i) {
    out->present[i] = 1;
    if (!with_positions) continue;
    const double x = (static_cast<double>(i) - middle) * pitch_;
    // Turned, and tilted, so that the grid does not lie along the axes.
    const double turned_x = 0.8 * x - 0.6 * y, turned_y = 0.6 * x + 0.8 * y;
    const auto seed = static_cast<uint32_t>(seed_);
    const double relief =
        0.03 * static_cast<double>(ValueNoise(
                   static_cast<float>(i) * static_cast<float>(pitch_ * 5),
                   static_cast<float>(row) * static_cast<float>(pitch_ * 5), 0.5f, seed));
    const double noise = pitch_ * kNoise * SensorNoise(Mix(seed_ + row * columns_ + i));
    out->xyz[3 * i] = kUnit * turned_x;
    out->xyz[3 * i + 1] = kUnit * turned_y;
    out->xyz[3 * i + 2] = kUnit * (-1.7 + 0.08 * turned_x + relief + noise);
  }
}

}  // namespace folprom::cli
