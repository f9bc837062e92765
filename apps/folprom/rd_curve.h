// A measured rate-distortion curve as JSON, CSV, plot and table.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/folprom/rd_plot.h"
#include "apps/folprom/report.h"
#include "folprom/measure.h"
#include "folprom/settings.h"

namespace folprom::cli {

/// Rates in bits per vertex where none are given.
inline constexpr const char* kDefaultRates = "0.25,0.5,1,2,4,8,12,16";
/// What WriteCurve appends to its prefix.
inline constexpr const char* kCurveSuffixes[] = {".json", ".csv", ".svg"};

/// What a curve was measured of.
struct CurveOrigin {
  std::string scan;
  std::string config;  ///< file, or empty
  std::string label;   ///< of the settings, in the plot
  EncodeOptions options;
};

/// What the plot of a curve tells.
struct CurvePlot {
  std::string scan;   ///< name, for the title
  std::string label;  ///< of the settings
  uint64_t vertices = 0, faces = 0;
  double bits_per_vertex = 0;  ///< of the whole file
  std::vector<PlotPoint> points;
};

/// Beside the curve those that others have published of the scan.
std::string SvgOf(const CurvePlot& curve);

/// "0.5,1,2", each above 0. Throws Failure kUsage with the name of the option.
std::vector<double> ParseRates(const std::string& text, const std::string& option = "--bpv");

/// The larger of both directions.
DistanceStatistics LargerOf(const Comparison& comparison);
/// Part of the diagonal; a single point has none.
std::optional<double> Relative(double distance, const Comparison& comparison);

Json CurveJson(const CurveOrigin& origin, const RateCurve& curve, double seconds);
std::string CurveTable(const std::string& scan, const RateCurve& curve);
/// Writes the JSON, a table as CSV and a plot as SVG. Throws Failure kOutput.
void WriteCurve(const std::string& prefix, const CurveOrigin& origin, const RateCurve& curve,
                const Json& json, bool force);

}  // namespace folprom::cli
