#include "apps/folprom/config_keys.h"

#include <spdlog/fmt/fmt.h>

#include <charconv>
#include <limits>
#include <sstream>
#include <type_traits>

#include "apps/folprom/limit_flags.h"
#include "apps/folprom/options.h"
#include "apps/folprom/toml_parser.h"
#include "folprom/settings_keys.h"

namespace folprom::cli {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

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

template <class T, class Text>
std::string ListText(const std::vector<T>& values, Text text_of) {
  std::string text;
  for (const T& value : values) text += (text.empty() ? "" : ", ") + text_of(value);
  return "[" + text + "]";
}

struct TextOfValue {
  const Key& key;

  std::string operator()(const bool* value) const { return *value ? "true" : "false"; }
  std::string operator()(const double* value) const { return FloatText(*value); }
  std::string operator()(const uint32_t* value) const { return std::to_string(*value); }
  std::string operator()(const uint64_t* value) const { return QuotedText(BytesText(*value)); }
  std::string operator()(Count count) const { return std::to_string(*count.value); }
  std::string operator()(const std::string* value) const { return QuotedText(*value); }
  std::string operator()(const std::vector<std::string>* value) const {
    return ListText(*value, QuotedText);
  }
  std::string operator()(const std::vector<double>* value) const {
    return ListText(*value, FloatText);
  }
  std::string operator()(std::monostate) const { return ""; }
  template <class Enum>
  requires std::is_enum_v<Enum> std::string operator()(const Enum* value) const {
    return QuotedText(key.choices[static_cast<size_t>(*value)]);
  }
};

}  // namespace

std::vector<Key> EncodeKeys(EncodeConfig& config) {
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
      {"encode", "attributes", &o.attributes,
       "colours, normals, all else of vertices and faces, and comments come back; needs offsets = "
       "\"lattice\"",
       ""},
      {"encode", "attribute_bits", &o.attribute_bits,
       "float attributes of vertices that are rounded: \"normal=10\", each to 2^N values over its "
       "range",
       ""},
      {"encode", "keep_order", &o.keep_order,
       "vertices and faces come back in the scan's order, faces with their first corner first; "
       "needs offsets = \"lattice\"",
       ""},
      {"encode", "weld", &o.weld,
       "vertices of equal coordinates become one, so that a soup, such as STL files are, becomes a "
       "surface; needs attributes = false where vertices have any",
       ""},
      {"encode", "threads", &config.threads, "0: all; never alters the file", "threads", 0, 1024},
      {"encode", "memory", &o.limits.memory_bytes,
       "resident size to stay below; never alters the file", "bytes, or a text such as \"2GiB\"", 1,
       kNoLimit},
      {"encode", "tmp", &o.temporary_folder, "folder for temporary files; empty: $TMPDIR or /tmp",
       ""},
  };
  for (const LimitName& limit : LimitNames()) {
    uint64_t* value = &(o.limits.*limit.member);
    Key key{"encode", limit.key, value, limit.meaning, "bytes, or a text such as \"2MiB\"",
            1,        kNoLimit};
    if (!limit.is_bytes) {
      key.value = Count{value};
      key.unit = "a text such as \"20M\", or a number";
    }
    keys.push_back(key);
  }
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

std::string ValueText(const Key& key) { return std::visit(TextOfValue{key}, key.value); }

std::string ChoicesText(const Key& key) {
  std::string text;
  for (const std::string_view choice : key.choices) {
    if (!text.empty()) text += " or ";
    text += fmt::format("\"{}\"", choice);
  }
  return text;
}

std::string RangeText(const Key& key) {
  if (!key.choices.empty()) return ChoicesText(key);
  if (std::holds_alternative<bool*>(key.value)) return "true or false";
  // Texts and tables.
  if (key.lo == 0 && key.hi == 0) return "";
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

std::string CommentText(const Key& key, const std::string& default_value) {
  const std::string range = RangeText(key);
  std::string text;
  if (!key.unit.empty()) text += fmt::format(" unit: {};", key.unit);
  if (!range.empty()) text += fmt::format(" range: {};", range);
  if (!default_value.empty()) text += fmt::format(" default: {}", default_value);
  if (text.ends_with(';')) text.pop_back();
  if (!text.empty()) text = fmt::format("#{}\n", text);
  return fmt::format("# {}\n{}", key.meaning, text);
}

}  // namespace folprom::cli
