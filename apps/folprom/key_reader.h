// Reads the keys of a TOML table into the values of a table of keys, with errors that help.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "apps/folprom/config_keys.h"
#include "apps/folprom/toml_parser.h"
#include "io/files/mapped_file.h"

namespace folprom::cli {

/// A TOML file. All errors are thrown as Failure "file:line: message", kUsage; kInput where the
/// file cannot be read.
class TomlFile {
 public:
  explicit TomlFile(const std::string& path);
  const toml::table& root() const { return root_; }
  [[noreturn]] void Fail(const toml::node& where, const std::string& message) const;

 private:
  std::string path_;
  toml::table root_;
};

/// Overwrites the value of the key that has this name in this table; Fail where there is none (with
/// the nearest known key), the type is wrong or the value is out of range. False for a monostate,
/// which is left to the caller.
bool ReadKey(const TomlFile& file, std::span<const Key> keys, std::string_view table,
             std::string_view name, const toml::node& node);

/// "; the nearest known key is codec.children": the one that is spelt most alike; the own table
/// wins among equals.
std::string NearestKey(std::span<const Key> keys, std::string_view table, std::string_view name);

}  // namespace folprom::cli
