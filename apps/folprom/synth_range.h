// The synthetic range scan: what depth cameras around an object measure, a grid of pixels each.
#pragma once

#include <array>
#include <cstdint>

#include "apps/folprom/synth_rows.h"

namespace folprom::cli {

/// A depth image of the object, each pixel carried back along its ray with noise in its depth.
/// Pixels that see nothing are absent, and some that the sensor loses.
class RangeView : public RowSource {
 public:
  /// pitch: distance of the pixels' rays at the middle of the object, whose radius is about 1.
  /// turn: where the camera stands around the object, in turns; rise: how far above it looks down.
  RangeView(double pitch, double turn, double rise, uint64_t object_seed, uint64_t seed);

  /// About how many pixels see the object if they are `pitch` apart.
  static double PixelsSeen(double pitch);

  uint64_t row_count() const override { return side_; }
  bool ring() const override { return false; }
  void FillRow(uint64_t row, bool with_positions, SampleRow* out) const override;

 private:
  using Point = std::array<double, 3>;
  bool MeetObject(const Point& ray, double* depth) const;
  double DistanceBound(const Point& p, bool detailed) const;

  double pitch_;
  uint64_t side_;  ///< of the square image, pixels
  uint64_t seed_;
  uint32_t noise_seed_;
  Point eye_, right_, up_, ahead_;
};

/// The board that the object stands on, seen from straight above and to its edges, so that it can
/// have any number of samples.
class RangeBoard : public RowSource {
 public:
  /// samples: at least 4.
  RangeBoard(uint64_t samples, double pitch, uint64_t seed);

  uint64_t row_count() const override { return (samples_ + columns_ - 1) / columns_; }
  bool ring() const override { return false; }
  void FillRow(uint64_t row, bool with_positions, SampleRow* out) const override;

 private:
  uint64_t samples_;
  uint64_t columns_;
  double pitch_;
  uint64_t seed_;
};

}  // namespace folprom::cli
