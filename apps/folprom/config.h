// Settings of `encode` as a TOML file: tables [codec] and [encode].
#pragma once

#include <cstdint>
#include <string>

#include "folprom/result.h"
#include "folprom/settings.h"

namespace folprom::cli {

/// All that a config file can say. Default: the program's defaults.
struct EncodeConfig {
  EncodeOptions options;
  uint32_t threads = 0;  ///< 0: all
};

/// Overwrites what the file names. Errors name file, line and key: kInput where the file cannot be
/// read, kUsage for syntax, an unknown key (with the nearest known one), a wrong type, a value out
/// of range.
Result<void> ReadConfig(const std::string& path, EncodeConfig* config);

/// kUsage where a value is out of the range of its key, whatever it came from.
Result<void> CheckConfig(const EncodeConfig& config);

/// The settings as TOML, every key with its meaning, unit, range and default. ReadConfig reads the
/// same settings back.
std::string ConfigText(const EncodeConfig& config);

}  // namespace folprom::cli
