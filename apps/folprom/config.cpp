#include "apps/folprom/config.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <span>
#include <sstream>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "apps/folprom/options.h"
#include "apps/folprom/toml_parser.h"
#include "folprom/settings_keys.h"
#include "io/files/mapped_file.h"

namespace folprom::cli {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

// A key of the file and the value that it stands for. uint64_t is a size in bytes.
struct Key {
  std::string_view table;
  std::string_view name;
  std::variant<uint32_t*, uint64_t*, double*, bool*, std::string*, Hierarchy*, Offsets*,
               Representative*>
      value;
  std::string_view meaning;
  std::string_view unit;
  double lo = 0;
  double hi = 0;
  std::span<const std::string_view> choices = {};

  std::string full_name() const { return std::string(table) + "." + std::string(name); }
};

// Every key of a config file, in the order in which it is printed.
std::vector<Key> Keys(EncodeConfig& config) {
  EncodeOptions& o = config.options;
  std::vector<Key> keys = {
      {"encode", "bits", &o.bits,
       "the lattice has 2^bits - 1 steps along the longest side; used where tolerance is 0", "bits",
       1, 24},
      {"encode", "tolerance", &o.tolerance, "largest error per axis; 0: from bits", "model units",
       0, kLargestTolerance},
      {"encode", "exact", &o.exact,
       "positions come back bit for bit, whatever bits and tolerance are; needs offsets = "
       "\"lattice\"",
       ""},
      {"encode", "threads", &config.threads, "0: all; never alters the file", "threads", 0, 1024},
      {"encode", "memory", &o.memory_bytes, "resident size to stay below; never alters the file",
       "bytes, or a text such as \"2GiB\"", 1, kNoLimit},
      {"encode", "tmp", &o.temporary_folder, "folder for temporary files; empty: $TMPDIR or /tmp",
       ""},
  };
  for (const SettingKey& key : SettingKeys()) {
    std::visit(
        [&](auto member) {
          keys.push_back({"codec", key.name, &(o.codec.*member), key.meaning, key.unit, key.lo,
                          key.hi, key.choices});
        },
        key.member);
  }
  return keys;
}

// ----- text of values

std::string FloatText(double value) {
  char buffer[32];
  std::string text(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
  // TOML tells floats from integers by their look.
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string QuotedText(std::string_view value) {
  const toml::value<std::string> quoted{std::string(value)};
  std::ostringstream text;
  text << toml::toml_formatter(quoted, toml::format_flags::none);
  return text.str();
}

std::string ValueText(const Key& key) {
  return std::visit(
      [&](auto* value) -> std::string {
        using T = std::remove_pointer_t<decltype(value)>;
        if constexpr (std::is_same_v<T, bool>) {
          return *value ? "true" : "false";
        } else if constexpr (std::is_same_v<T, double>) {
          return FloatText(*value);
        } else if constexpr (std::is_same_v<T, uint32_t>) {
          return std::to_string(*value);
        } else if constexpr (std::is_same_v<T, uint64_t>) {
          return QuotedText(BytesText(*value));
        } else if constexpr (std::is_same_v<T, std::string>) {
          return QuotedText(*value);
        } else {
          return QuotedText(key.choices[static_cast<size_t>(*value)]);
        }
      },
      key.value);
}

std::string ChoicesText(const Key& key) {
  std::string text;
  for (const std::string_view choice : key.choices) {
    if (!text.empty()) text += " or ";
    text += fmt::format("\"{}\"", choice);
  }
  return text;
}

// What may stand as the value; empty where anything of the type may.
std::string RangeText(const Key& key) {
  if (!key.choices.empty()) return ChoicesText(key);
  if (std::holds_alternative<bool*>(key.value)) return "true or false";
  if (std::holds_alternative<std::string*>(key.value)) return "";
  std::ostringstream text;
  text.precision(10);
  text << key.lo;
  if (key.hi == kNoLimit) {
    text << " or more";
  } else {
    text << " .. " << key.hi;
  }
  return text.str();
}

// ----- reading

class ConfigReader {
 public:
  ConfigReader(const std::string& path, EncodeConfig* config)
      : path_(path), config_(config), keys_(Keys(*config)) {}

  void Read(const toml::table& root) {
    // First, so that whatever else the file gives wins over it.
    if (const toml::node* effort = root["codec"]["effort"].node()) {
      ReadKey("codec", "effort", *effort);
      CodecSettings& codec = config_->options.codec;
      codec = WithEffort(codec, codec.effort);
    }
    for (const auto& [table_name, node] : root) {
      const std::string_view table = table_name.str();
      if (!node.is_table()) {
        Fail(node, "key " + std::string(table) + " stands outside the tables [codec] and [encode]" +
                       Suggestion("", table));
      }
      if (table != "codec" && table != "encode") {
        Fail(node, "unknown table [" + std::string(table) + "]; there are [codec] and [encode]");
      }
      for (const auto& [name, value] : *node.as_table()) ReadKey(table, name.str(), value);
    }
  }

  [[noreturn]] void Fail(const toml::source_region& where, const std::string& message) const {
    throw Failure(ErrorKind::kUsage,
                  path_ + ":" + std::to_string(where.begin.line) + ": " + message);
  }

 private:
  [[noreturn]] void Fail(const toml::node& where, const std::string& message) const {
    Fail(where.source(), message);
  }

  void ReadKey(std::string_view table, std::string_view name, const toml::node& node) {
    for (const Key& key : keys_) {
      if (key.table == table && key.name == name) {
        std::visit([&](auto* value) { ReadValue(key, node, value); }, key.value);
        return;
      }
    }
    Fail(node,
         "unknown key " + std::string(table) + "." + std::string(name) + Suggestion(table, name));
  }

  // The known key that is spelt most alike; the own table wins among equals.
  std::string Suggestion(std::string_view table, std::string_view name) const {
    const Key* nearest = nullptr;
    size_t smallest = 0;
    for (const Key& key : keys_) {
      const size_t distance = 2 * EditDistance(key.name, name) + (key.table == table ? 0 : 1);
      if (nearest == nullptr || distance < smallest) {
        nearest = &key;
        smallest = distance;
      }
    }
    return "; the nearest known key is " + nearest->full_name();
  }

  static size_t EditDistance(std::string_view a, std::string_view b) {
    std::vector<size_t> row(b.size() + 1);
    for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (size_t i = 1; i <= a.size(); ++i) {
      size_t diagonal = std::exchange(row[0], i);
      for (size_t j = 1; j <= b.size(); ++j) {
        const size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
        diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, replaced}));
      }
    }
    return row.back();
  }

  [[noreturn]] void WrongType(const Key& key, const toml::node& node, const char* wanted) const {
    Fail(node, "key " + key.full_name() + " must be " + wanted);
  }

  double InRange(const Key& key, const toml::node& node, double value) const {
    if (std::isfinite(value) && value >= key.lo && value <= key.hi) return value;
    Fail(node, "key " + key.full_name() + " is out of range, must be " + RangeText(key));
  }

  void ReadValue(const Key& key, const toml::node& node, bool* value) const {
    if (!node.is_boolean()) WrongType(key, node, "true or false");
    *value = node.as_boolean()->get();
  }

  void ReadValue(const Key& key, const toml::node& node, double* value) const {
    if (!node.is_number()) WrongType(key, node, "a number");
    // node.value<double>() has nothing for an integer that a double does not hold exactly.
    const double number = node.is_integer() ? static_cast<double>(node.as_integer()->get())
                                            : node.as_floating_point()->get();
    *value = InRange(key, node, number);
  }

  void ReadValue(const Key& key, const toml::node& node, uint32_t* value) const {
    if (!node.is_integer()) WrongType(key, node, "an integer");
    *value = static_cast<uint32_t>(InRange(key, node, static_cast<double>(*node.value<int64_t>())));
  }

  void ReadValue(const Key& key, const toml::node& node, uint64_t* value) const {
    if (node.is_integer()) {
      InRange(key, node, static_cast<double>(*node.value<int64_t>()));
      *value = static_cast<uint64_t>(*node.value<int64_t>());
      return;
    }
    if (!node.is_string()) WrongType(key, node, "a number of bytes or a text such as \"2GiB\"");
    auto bytes = ParseBytes(node.as_string()->get());
    if (!bytes) Fail(node, "key " + key.full_name() + ": " + bytes.error().message);
    InRange(key, node, static_cast<double>(*bytes));
    *value = *bytes;
  }

  void ReadValue(const Key& key, const toml::node& node, std::string* value) const {
    if (!node.is_string()) WrongType(key, node, "a text in quotes");
    *value = node.as_string()->get();
  }

  template <class Enum>
  requires std::is_enum_v<Enum>
  void ReadValue(const Key& key, const toml::node& node, Enum* value) const {
    if (!node.is_string()) WrongType(key, node, "a text in quotes");
    for (size_t i = 0; i < key.choices.size(); ++i) {
      if (key.choices[i] == node.as_string()->get()) {
        *value = static_cast<Enum>(i);
        return;
      }
    }
    Fail(node, "key " + key.full_name() + " must be " + ChoicesText(key));
  }

  std::string path_;
  EncodeConfig* config_;
  std::vector<Key> keys_;
};

}  // namespace

Result<void> ReadConfig(const std::string& path, EncodeConfig* config) {
  try {
    EncodeConfig changed = *config;
    ConfigReader reader(path, &changed);
    const io::MappedFile file = io::MappedFile::Open(path).value();
    const std::string_view text(reinterpret_cast<const char*>(file.bytes().data()),
                                file.bytes().size());
    const toml::parse_result parsed = toml::parse(text, path);
    if (!parsed) reader.Fail(parsed.error().source(), std::string(parsed.error().description()));
    reader.Read(parsed.table());
    *config = changed;
    return {};
  } catch (const Failure& failure) {
    return failure.error();
  }
}

Result<void> CheckConfig(const EncodeConfig& config) {
  EncodeConfig copy = config;
  for (const Key& key : Keys(copy)) {
    if (key.table == "codec") continue;
    const bool in_range = std::visit(
        [&](auto* value) {
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
  const std::vector<Key> keys = Keys(shown);
  const std::vector<Key> default_keys = Keys(defaults);
  std::ostringstream text;
  std::string_view table;
  for (size_t i = 0; i < keys.size(); ++i) {
    const Key& key = keys[i];
    if (key.table != table) {
      text << (table.empty() ? "" : "\n") << "[" << key.table << "]\n";
      table = key.table;
    }
    const std::string range = RangeText(key);
    text << "\n# " << key.meaning << "\n#";
    if (!key.unit.empty()) text << " unit: " << key.unit << ";";
    if (!range.empty()) text << " range: " << range << ";";
    text << " default: " << ValueText(default_keys[i]) << "\n";
    text << key.name << " = " << ValueText(key) << "\n";
  }
  return text.str();
}

}  // namespace folprom::cli
