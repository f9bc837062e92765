// A rate-distortion curve as a picture.
#pragma once

#include <string>
#include <vector>

namespace folprom::cli {

struct PlotPoint {
  double rate = 0;   ///< bits per vertex
  double error = 0;  ///< 1e-4 of the diagonal
};

struct PlotSeries {
  std::string name;
  std::vector<PlotPoint> points;
};

struct RatePlot {
  std::string title;
  std::string subtitle;
  /// At most three, each with a style of its own, the first one boldest; empty ones are not shown.
  std::vector<PlotSeries> series;
};

/// An SVG with both axes logarithmic. Points without rate or error have no place and are left out.
std::string SvgOf(const RatePlot& plot);

}  // namespace folprom::cli
