// What error folprom has at each rate, beside "simplify, then Draco" and the paper.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/peers/contenders.h"

namespace folprom::peers {

struct CurvePoint {
  double bits_per_vertex = 0;  ///< reached, never above the rate asked for
  double error = 0;            ///< mean, larger of the two directions, 1e-4 of the diagonal
  uint64_t faces = 0;
  int position_bits = 0;  ///< of simplify + Draco
};

struct CurveSeries {
  std::string name;
  std::vector<std::optional<CurvePoint>> points;  ///< one for each rate; none where nothing fits
};

struct Curve {
  std::string scan;  ///< name without folder and suffix
  ScanSize size;
  std::vector<double> rates;
  uint64_t samples = 0;              ///< of each comparison
  int bits = 0;                      ///< of folprom's positions
  CurveSeries simplify;              ///< then Draco
  std::vector<CurveSeries> folprom;  ///< one for each setting
  std::vector<double> paper;         ///< published errors at the rates, 0 where there is none
};

/// Searches the envelope and runs `folprom rd` for each setting. Progress goes to standard error.
/// Throws Failure.
Curve MeasureCurve(const std::string& scan, const ContenderOptions& options,
                   const std::vector<double>& rates);

/// A plot of it: the first setting of folprom, the paper, simplify + Draco.
std::string SvgOf(const Curve& curve);

}  // namespace folprom::peers
