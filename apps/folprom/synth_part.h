// One component of the synthetic scan.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/folprom/synth_rows.h"

namespace folprom::cli {

enum class PartShape : uint8_t {
  kBlob,   ///< a deformed sphere, open at the bottom; rows are circles of latitude
  kPatch,  ///< a sheet with a ragged outline
  kSheet   ///< a square sheet without holes, of an exact number of samples
};

/// A component. Row r depends on these values and r only.
class Part : public RowSource {
 public:
  /// `samples`: how many to place; a blob or patch places about as many and loses some to holes, a
  /// sheet (at least 4) has exactly that many. `size`: half of its extent, model units.
  Part(PartShape shape, uint64_t samples, std::array<double, 3> centre, double size, uint64_t seed);

  uint64_t row_count() const override { return rows_; }
  bool ring() const override { return shape_ == PartShape::kBlob; }
  void FillRow(uint64_t row, bool with_positions, SampleRow* out) const override;

 private:
  /// Values of the samples of a row.
  struct Scratch {
    std::vector<float> x, y, z;                    ///< on the unit shape
    std::vector<float> noise_x, noise_y, noise_z;  ///< where the noise is looked up, all positive
    std::vector<float> coarse;                     ///< relief in units of the shape
    std::vector<float> fine;                       ///< finest relief in [-1, 1]
    std::vector<float> jitter;                     ///< measurement noise in [-1, 1]
  };

  double CountDeviation(uint64_t row) const;
  uint64_t SamplesInRow(uint64_t row) const;
  void PlaceSamples(uint64_t row, SampleRow* out) const;
  void AddNoise(uint64_t octave, float frequency, float height, std::vector<float>* sum) const;
  void HideSamples(SampleRow* out) const;
  void RaiseSamples(SampleRow* out) const;

  PartShape shape_;
  uint64_t samples_;
  std::array<double, 3> centre_;
  double size_;
  uint64_t seed_;
  double spacing_;  ///< of samples on the unit shape
  uint64_t rows_;
  mutable Scratch scratch_;  ///< of the row at hand, kept to save allocations
};

}  // namespace folprom::cli
