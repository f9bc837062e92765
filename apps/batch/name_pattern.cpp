#include "apps/batch/name_pattern.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>

namespace folprom::batch {
namespace {

namespace fs = std::filesystem;

// Calls text(part) and field(name) in their order; what is wrong with the braces, if anything.
template <class Text, class Field>
std::optional<std::string> Walk(std::string_view pattern, Text text, Field field) {
  while (!pattern.empty()) {
    const size_t brace = std::min(pattern.find_first_of("{}"), pattern.size());
    text(pattern.substr(0, brace));
    pattern.remove_prefix(brace);
    if (pattern.empty()) break;
    const size_t end = pattern.find_first_of("{}", 1);
    if (pattern.front() == '}' || end == std::string_view::npos || pattern[end] == '{') {
      return "has a brace without its other half";
    }
    field(pattern.substr(1, end - 1));
    pattern.remove_prefix(end + 1);
  }
  return std::nullopt;
}

const std::string* FieldOf(const NameFields& fields, std::string_view name) {
  if (name == "stem") return &fields.stem;
  if (name == "name") return &fields.name;
  if (name == "folder") return &fields.folder;
  if (name == "job") return &fields.job;
  return nullptr;
}

}  // namespace

Result<void> CheckPattern(const std::string& pattern) {
  const auto wrong = [&](const std::string& reason) {
    return Error{ErrorKind::kUsage, "pattern \"" + pattern + "\" " + reason};
  };
  const NameFields sample{"scan", "scan.ply", "folder", "job"};
  std::optional<std::string> unknown;
  const auto fault = Walk(
      pattern, [](std::string_view) {},
      [&](std::string_view name) {
        if (FieldOf(sample, name) == nullptr) unknown = std::string(name);
      });
  if (fault) return wrong(*fault);
  if (unknown) {
    return wrong("has the unknown field {" + *unknown +
                 "}; there are {stem}, {name}, {folder} and {job}");
  }
  if (pattern.empty() || pattern.ends_with('/')) return wrong("does not end in a file name");
  const fs::path expanded = ExpandPattern(pattern, sample);
  if (fs::path(pattern).is_absolute()) return wrong("must be relative to the output folder");
  if (std::find(expanded.begin(), expanded.end(), "..") != expanded.end()) {
    return wrong("leads out of the output folder");
  }
  if (expanded.filename().string().starts_with('.')) return wrong("makes hidden files");
  return {};
}

std::string ExpandPattern(const std::string& pattern, const NameFields& fields) {
  std::string expanded;
  Walk(
      pattern, [&](std::string_view part) { expanded += part; },
      [&](std::string_view name) { expanded += *FieldOf(fields, name); });
  // An empty folder leaves a slash at the front.
  const size_t begin = std::min(expanded.find_first_not_of('/'), expanded.size());
  return fs::path(expanded.substr(begin)).lexically_normal().string();
}

}  // namespace folprom::batch
