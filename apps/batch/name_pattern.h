// How the outputs of a scan are named.
#pragma once

#include <string>

#include "folprom/result.h"

namespace folprom::batch {

/// What stands in for the fields of a pattern.
struct NameFields {
  std::string stem;    ///< of the scan's file name
  std::string name;    ///< whole file name
  std::string folder;  ///< of the scan, below the fixed part of its glob; may be empty
  std::string job;
};

/// kUsage where the pattern has an unknown field, a brace without its other half, is empty, or
/// leads out of the output folder.
Result<void> CheckPattern(const std::string& pattern);
/// A relative path without extension. The pattern has passed CheckPattern.
std::string ExpandPattern(const std::string& pattern, const NameFields& fields);

}  // namespace folprom::batch
