// "NAME=N": to how many bits an attribute is rounded.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "folprom/result.h"

namespace folprom {

struct AttributeBits {
  std::string name;
  uint32_t bits = 0;  ///< 1 .. 24

  /// Does it stand for the attribute of this name.
  bool Names(std::string_view attribute) const {
    if (name == "normal") return attribute == "nx" || attribute == "ny" || attribute == "nz";
    return name == attribute;
  }
};

/// kUsage with the first text that has another form.
Result<std::vector<AttributeBits>> ParseAttributeBits(const std::vector<std::string>& texts);

}  // namespace folprom
