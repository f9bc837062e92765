#include "apps/folprom/key_reader.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>
#include <vector>

#include "apps/folprom/options.h"

namespace folprom::cli {
namespace {

[[noreturn]] void FailAt(const std::string& path, const toml::source_region& where,
                         const std::string& message) {
  throw Failure(ErrorKind::kUsage, path + ":" + std::to_string(where.begin.line) + ": " + message);
}

size_t EditDistance(std::string_view a, std::string_view b) {
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

// Reads one node by the type of the key's value.
class ValueReader {
 public:
  ValueReader(const TomlFile& file, const Key& key, const toml::node& node)
      : file_(file), key_(key), node_(node) {}

  bool operator()(std::monostate) const { return false; }

  bool operator()(bool* value) const {
    if (!node_.is_boolean()) WrongType("true or false");
    *value = node_.as_boolean()->get();
    return true;
  }

  bool operator()(double* value) const {
    if (!node_.is_number()) WrongType("a number");
    *value = Number(node_);
    return true;
  }

  bool operator()(uint32_t* value) const {
    if (!node_.is_integer()) WrongType("an integer");
    *value = static_cast<uint32_t>(InRange(static_cast<double>(*node_.value<int64_t>())));
    return true;
  }

  bool operator()(uint64_t* value) const {
    *value = Scaled("a number of bytes or a text such as \"2GiB\"", ParseBytes);
    return true;
  }

  bool operator()(Count count) const {
    *count.value = Scaled("an integer or a text such as \"20k\"", ParseCount);
    return true;
  }

  bool operator()(std::string* value) const {
    *value = Text(node_, "a text in quotes");
    return true;
  }

  // One text may stand without brackets.
  bool operator()(std::vector<std::string>* value) const {
    constexpr const char* kWanted = "a text in quotes or a list of such";
    value->clear();
    if (!node_.is_array()) {
      value->push_back(Text(node_, kWanted));
      return true;
    }
    for (const toml::node& item : *node_.as_array()) value->push_back(Text(item, kWanted));
    return true;
  }

  bool operator()(std::vector<double>* value) const {
    constexpr const char* kWanted = "a list of numbers";
    if (!node_.is_array()) WrongType(kWanted);
    value->clear();
    for (const toml::node& item : *node_.as_array()) {
      if (!item.is_number()) WrongType(kWanted);
      value->push_back(Number(item));
    }
    return true;
  }

  template <class Enum>
  requires std::is_enum_v<Enum>
  bool operator()(Enum* value) const {
    const std::string text = Text(node_, "a text in quotes");
    const auto choice = std::find(key_.choices.begin(), key_.choices.end(), text);
    *value = static_cast<Enum>(choice - key_.choices.begin());
    return true;
  }

 private:
  [[noreturn]] void WrongType(const char* wanted) const {
    file_.Fail(node_, "key " + key_.full_name() + " must be " + wanted);
  }

  double InRange(double value) const {
    if (std::isfinite(value) && value >= key_.lo && value <= key_.hi) return value;
    file_.Fail(node_, "key " + key_.full_name() + " is out of range, must be " + RangeText(key_));
  }

  // node.value<double>() has nothing for an integer that a double does not hold exactly.
  double Number(const toml::node& node) const {
    return InRange(node.is_integer() ? static_cast<double>(node.as_integer()->get())
                                     : node.as_floating_point()->get());
  }

  std::string Text(const toml::node& node, const char* wanted) const {
    if (!node.is_string()) WrongType(wanted);
    const std::string& text = node.as_string()->get();
    if (!key_.choices.empty() &&
        std::find(key_.choices.begin(), key_.choices.end(), text) == key_.choices.end()) {
      file_.Fail(node, "key " + key_.full_name() + " must be " + ChoicesText(key_));
    }
    return text;
  }

  template <class Parse>
  uint64_t Scaled(const char* wanted, Parse parse) const {
    if (node_.is_integer()) {
      InRange(static_cast<double>(*node_.value<int64_t>()));
      return static_cast<uint64_t>(*node_.value<int64_t>());
    }
    if (!node_.is_string()) WrongType(wanted);
    Result<uint64_t> value = parse(node_.as_string()->get());
    if (!value) file_.Fail(node_, "key " + key_.full_name() + ": " + value.error().message);
    InRange(static_cast<double>(*value));
    return *value;
  }

  const TomlFile& file_;
  const Key& key_;
  const toml::node& node_;
};

}  // namespace

TomlFile::TomlFile(const std::string& path) : path_(path) {
  const io::MappedFile file = std::move(io::MappedFile::Open(path).value());
  const std::string_view text(reinterpret_cast<const char*>(file.bytes().data()),
                              file.bytes().size());
  toml::parse_result parsed = toml::parse(text, path);
  if (!parsed) {
    FailAt(path, parsed.error().source(), std::string(parsed.error().description()));
  }
  root_ = std::move(parsed).table();
}

void TomlFile::Fail(const toml::node& where, const std::string& message) const {
  FailAt(path_, where.source(), message);
}

bool ReadKey(const TomlFile& file, std::span<const Key> keys, std::string_view table,
             std::string_view name, const toml::node& node) {
  for (const Key& key : keys) {
    if (key.table != table || key.name != name) continue;
    return std::visit(ValueReader(file, key, node), key.value);
  }
  file.Fail(node, "unknown key " + std::string(table) + "." + std::string(name) +
                      NearestKey(keys, table, name));
}

std::string NearestKey(std::span<const Key> keys, std::string_view table, std::string_view name) {
  const Key* nearest = nullptr;
  size_t smallest = 0;
  for (const Key& key : keys) {
    const size_t distance = 2 * EditDistance(key.name, name) + (key.table == table ? 0 : 1);
    if (nearest == nullptr || distance < smallest) {
      nearest = &key;
      smallest = distance;
    }
  }
  return "; the nearest known key is " + nearest->full_name();
}

}  // namespace folprom::cli
