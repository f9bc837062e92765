// --limit NAME=N: what an input may ask for.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "folprom/limits.h"

namespace CLI {
class App;
}  // namespace CLI

namespace folprom::cli {

/// A limit as a key of a settings file, "limit_NAME", and by its name alone on the command line.
struct LimitName {
  std::string_view key;
  uint64_t Limits::*member;
  bool is_bytes;
  std::string_view meaning;

  std::string_view name() const { return key.substr(std::string_view("limit_").size()); }
};

/// All but the memory, which has a flag and a key of its own.
std::span<const LimitName> LimitNames();

struct LimitFlags {
  std::vector<std::pair<uint64_t Limits::*, uint64_t>> values;

  void ApplyTo(Limits* limits) const;
};

/// --limit, which may be given several times.
void AddLimitFlag(CLI::App* verb, LimitFlags* flags);

}  // namespace folprom::cli
