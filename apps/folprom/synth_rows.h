// A component of a synthetic mesh as rows of samples, each computed from its number alone.
#pragma once

#include <cstdint>
#include <vector>

namespace folprom::cli {

/// The samples of one row, ordered by u. Every array has one entry a sample.
struct SampleRow {
  std::vector<double> u;         ///< place along the row, strictly ascending; of a ring in [0, 1)
  std::vector<double> lean;      ///< small number that decides between close diagonals
  std::vector<uint8_t> present;  ///< 0 inside a hole
  std::vector<double> depth;     ///< from the camera; empty where no camera is
  double most_jump = 0;          ///< of the depth inside a triangle
  std::vector<double> xyz;       ///< three a sample; only where positions were asked for
};

/// A component. A row depends on its number only.
class RowSource {
 public:
  virtual ~RowSource() = default;
  virtual uint64_t row_count() const = 0;
  /// Rows are rings: the last sample is a neighbour of the first.
  virtual bool ring() const = 0;
  virtual void FillRow(uint64_t row, bool with_positions, SampleRow* out) const = 0;
};

}  // namespace folprom::cli
