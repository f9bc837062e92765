#include "apps/folprom/config.h"

#include <cmath>
#include <sstream>
#include <type_traits>
#include <vector>

#include "apps/folprom/config_keys.h"
#include "apps/folprom/key_reader.h"

namespace folprom::cli {
namespace {

void Read(const TomlFile& file, EncodeConfig* config) {
  const std::vector<Key> keys = EncodeKeys(*config);
  const toml::table& root = file.root();
  // First, so that whatever else the file gives wins over it.
  if (const toml::node* effort = root["codec"]["effort"].node()) {
    ReadKey(file, keys, "codec", "effort", *effort);
    CodecSettings& codec = config->options.codec;
    codec = WithEffort(codec, codec.effort);
  }
  for (const auto& [table_name, node] : root) {
    const std::string_view table = table_name.str();
    if (!node.is_table()) {
      file.Fail(node, "key " + std::string(table) +
                          " stands outside the tables [codec] and [encode]" +
                          NearestKey(keys, "", table));
    }
    if (table != "codec" && table != "encode") {
      file.Fail(node, "unknown table [" + std::string(table) + "]; there are [codec] and [encode]");
    }
    for (const auto& [name, value] : *node.as_table()) {
      ReadKey(file, keys, table, name.str(), value);
    }
  }
}

}  // namespace

Result<void> ReadConfig(const std::string& path, EncodeConfig* config) {
  try {
    EncodeConfig changed = *config;
    Read(TomlFile(path), &changed);
    *config = changed;
    return {};
  } catch (const Failure& failure) {
    return failure.error();
  }
}

Result<void> CheckConfig(const EncodeConfig& config) {
  EncodeConfig copy = config;
  for (const Key& key : EncodeKeys(copy)) {
    if (key.table == "codec") continue;
    const bool in_range = std::visit(
        [&](auto value) {
          using T = std::remove_pointer_t<decltype(value)>;
          if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
            const auto number = static_cast<double>(*value);
            return std::isfinite(number) && number >= key.lo && number <= key.hi;
          } else {
            return true;
          }
        },
        key.value);
    if (!in_range) {
      return Error{ErrorKind::kUsage, std::string(key.name) + " must be " + RangeText(key)};
    }
  }
  return CheckOptions(config.options);
}

std::string ConfigText(const EncodeConfig& config) {
  EncodeConfig shown = config;
  EncodeConfig defaults;
  const std::vector<Key> keys = EncodeKeys(shown);
  const std::vector<Key> default_keys = EncodeKeys(defaults);
  std::ostringstream text;
  std::string_view table;
  for (size_t i = 0; i < keys.size(); ++i) {
    const Key& key = keys[i];
    if (key.table != table) {
      text << (table.empty() ? "" : "\n") << "[" << key.table << "]\n";
      table = key.table;
    }
    text << "\n" << CommentText(key, ValueText(default_keys[i]));
    text << key.name << " = " << ValueText(key) << "\n";
  }
  return text.str();
}

}  // namespace folprom::cli
