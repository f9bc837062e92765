// The paper's techniques, each with the settings that turn it off and what the paper says it gains.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "folprom/settings.h"
#include "tests/bench/ablation/measurement.h"

namespace folprom::bench {

using TurnOff = void (*)(CodecSettings&);

/// Measured by the error at equal rates.
struct RateExperiment {
  std::string technique;
  std::string claim;
  std::string error_name;
  TurnOff turn_off;
  double Curve::Point::*error;
};
const std::vector<RateExperiment>& RateExperiments();

/// Measured by the bits of what the technique is about.
struct BitExperiment {
  /// A number under the coder's contexts and for a plain arithmetic coder.
  struct Bits {
    double own, plain;
  };
  std::string technique;
  std::string claim;
  std::string unit;
  TurnOff turn_off;
  std::function<Bits(const Costs&)> bits;
};
const std::vector<BitExperiment>& BitExperiments();

}  // namespace folprom::bench
