// The one table of the coder's settings: config files are read, written and checked from it.
#pragma once

#include <span>
#include <string_view>
#include <variant>

#include "folprom/settings.h"

namespace folprom {

/// A key of the [codec] table, in the order of CodecSettings.
struct SettingKey {
  using Member =
      std::variant<uint32_t CodecSettings::*, double CodecSettings::*, bool CodecSettings::*,
                   Hierarchy CodecSettings::*, Offsets CodecSettings::*,
                   Representative CodecSettings::*, Models CodecSettings::*>;
  std::string_view name;  ///< also the name of the field
  Member member;
  std::string_view meaning;  ///< one line
  std::string_view unit;     ///< "" for a pure number
  double lo = 0;             ///< range of a number, both ends allowed
  double hi = 0;
  /// Names of the values of an enumeration, by value; empty for other types.
  std::span<const std::string_view> choices = {};
};

std::span<const SettingKey> SettingKeys();

}  // namespace folprom
