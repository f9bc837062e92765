// The table of keys that settings files are read, checked, printed and documented from.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "apps/folprom/config.h"

namespace folprom::cli {

/// A number of things, which a file may write as 20000 or "20k".
struct Count {
  uint64_t* value;
};

/// A key of a file and the value that it stands for. uint64_t is a size in bytes; of texts with
/// choices each must be one of them; monostate is read by whoever holds the table.
struct Key {
  std::string_view table;
  std::string_view name;
  std::variant<uint32_t*, uint64_t*, Count, double*, bool*, std::string*, std::vector<std::string>*,
               std::vector<double>*, Hierarchy*, Offsets*, Representative*, Models*, std::monostate>
      value;
  std::string_view meaning;
  std::string_view unit;
  double lo = 0;
  double hi = 0;
  std::span<const std::string_view> choices = {};

  std::string full_name() const { return std::string(table) + "." + std::string(name); }
};

/// Every key of [encode] and [codec], in the order in which it is printed.
std::vector<Key> EncodeKeys(EncodeConfig& config);

/// The value as TOML; empty for monostate.
std::string ValueText(const Key& key);
/// What may stand as the value; empty where anything of the type may.
std::string RangeText(const Key& key);
/// "a" or "b"
std::string ChoicesText(const Key& key);
/// The comment over a key: meaning, unit, range, and the default where `default_value` is not
/// empty.
std::string CommentText(const Key& key, const std::string& default_value);

}  // namespace folprom::cli
