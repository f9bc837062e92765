// Errors that others report for known scans, to draw beside one's own.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace folprom::cli {

/// Mean surface distance, the larger of the two directions, in 1e-4 of the bounding-box diagonal.
struct PublishedPoint {
  double bits_per_vertex = 0;
  double error = 0;
};

struct PublishedScan {
  uint64_t vertices = 0;
  std::span<const PublishedPoint> paper;     ///< FOLProM, 2010; empty where it has no such scan
  std::span<const PublishedPoint> simplify;  ///< best simplification at that rate, then Draco
};

/// The scan known by its vertex count, or null.
const PublishedScan* PublishedFor(uint64_t vertices);

/// The error at exactly this rate, 0 where there is none.
double ErrorAt(std::span<const PublishedPoint> points, double bits_per_vertex);

}  // namespace folprom::cli
