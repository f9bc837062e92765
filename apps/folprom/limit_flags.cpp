#include "apps/folprom/limit_flags.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <string>

#include "apps/folprom/options.h"

namespace folprom::cli {
namespace {

constexpr LimitName kNames[] = {
    {"limit_vertices", &Limits::vertices, false, "a scan of more vertices is refused"},
    {"limit_faces", &Limits::faces, false, "a scan of more faces is refused"},
    {"limit_properties", &Limits::properties, false, "a PLY of more properties is refused"},
    {"limit_header", &Limits::header_bytes, true, "a PLY with a longer header is refused"},
    {"limit_comments", &Limits::comment_bytes, true,
     "comments of a PLY beyond this are dropped, with a warning; at most 16MiB"},
};

std::string Names(const char* separator) {
  std::string text;
  for (const LimitName& limit : kNames) {
    text += (text.empty() ? "" : separator) + std::string(limit.name());
  }
  return text;
}

std::pair<uint64_t Limits::*, uint64_t> Parse(const std::string& text) {
  const size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const auto* limit = std::ranges::find(kNames, name, &LimitName::name);
  if (equals == std::string::npos || limit == std::end(kNames)) {
    throw Failure(ErrorKind::kUsage,
                  "--limit: '" + text + "' is not NAME=N with a NAME of " + Names(", "));
  }
  const std::string number = text.substr(equals + 1);
  const Result<uint64_t> value = limit->is_bytes ? ParseBytes(number) : ParseCount(number);
  if (!value) throw Failure(ErrorKind::kUsage, "--limit: " + value.error().message);
  return {limit->member, Result<uint64_t>(value).value()};
}

}  // namespace

std::span<const LimitName> LimitNames() { return kNames; }

void LimitFlags::ApplyTo(Limits* limits) const {
  for (const auto& [member, value] : values) limits->*member = value;
}

void AddLimitFlag(CLI::App* verb, LimitFlags* flags) {
  verb->add_option_function<std::vector<std::string>>(
          "--limit",
          [flags](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) flags->values.push_back(Parse(text));
          },
          "Refuse inputs of more than that, vertices=20G: " + Names(", "))
      ->type_name("NAME=N")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

}  // namespace folprom::cli
