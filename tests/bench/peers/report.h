// The measurements as text: Markdown for people, CSV for programs.
#pragma once

#include <string>

#include "tests/bench/peers/curve.h"
#include "tests/bench/peers/race.h"

namespace folprom::peers {

std::string MarkdownOf(const Race& race);
std::string MarkdownOf(const Curve& curve);

/// One row a standing, or a point; with the header line only where `header` is set.
std::string CsvOf(const Race& race, bool header);
std::string CsvOf(const Curve& curve, bool header);

}  // namespace folprom::peers
