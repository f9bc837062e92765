#include "apps/pages/command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <sstream>
#include <string_view>
#include <utility>

namespace folprom::pages {
namespace {

// By the word that stands for the value.
Files FilesOf(const std::string& value) {
  if (value.ends_with(".folp")) return Files::kFolp;
  if (value.ends_with(".toml")) return Files::kToml;
  if (value.ends_with(".png")) return Files::kPng;
  if (value == "SCAN") return Files::kMesh;
  if (value == "A" || value == "B" || value == "FILE") return Files::kMeshOrFolp;
  if (value == "DIR") return Files::kFolder;
  return value == "OUT" ? Files::kAny : Files::kNone;
}

// The parser tells of a value's check in words: "{x,y,z}", "value in {a->0,b->1} OR {0,1}" or
// "INT in [1 - 9]".
std::vector<std::string> ChoicesOf(const std::string& check) {
  std::vector<std::string> choices;
  const size_t open = check.find('{');
  const size_t close = check.find('}');
  if (open != std::string::npos && close != std::string::npos) {
    std::istringstream list(check.substr(open + 1, close - open - 1));
    for (std::string item; std::getline(list, item, ',');) {
      choices.push_back(item.substr(0, item.find("->")));
    }
    return choices;
  }
  constexpr std::string_view kRange = "INT in [";
  constexpr int kMostNumbers = 9;
  const size_t range = check.find(kRange);
  if (range == std::string::npos) return choices;
  const char* const end = check.data() + check.size();
  int lo = 0, hi = 0;
  const auto first = std::from_chars(check.data() + range + kRange.size(), end, lo);
  if (first.ec != std::errc() || end - first.ptr < 3) return choices;
  const auto second = std::from_chars(first.ptr + 3, end, hi);
  if (second.ec != std::errc() || hi - lo >= kMostNumbers) return choices;
  for (int number = lo; number <= hi; ++number) choices.push_back(std::to_string(number));
  return choices;
}

Argument ArgumentOf(const CLI::Option& option) {
  Argument argument;
  for (const std::string& name : option.get_snames()) argument.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) argument.names.push_back("--" + name);
  const std::string type = option.get_type_name();
  const size_t colon = type.find(':');
  const bool is_flag = option.get_items_expected_max() == 0;
  argument.value = argument.names.empty() ? option.get_name(true)
                   : is_flag              ? ""
                                          : type.substr(0, colon);
  argument.text = option.get_description();
  argument.required = option.get_required();
  argument.for_tests = option.get_group() == "For tests";
  if (!is_flag && colon != std::string::npos) argument.choices = ChoicesOf(type.substr(colon));
  argument.files = FilesOf(argument.value);
  for (const CLI::Option* other : option.get_excludes()) {
    argument.excludes.push_back(other->get_name());
  }
  std::sort(argument.excludes.begin(), argument.excludes.end());  // the parser has them by address
  return argument;
}

// A summary line; then blocks between empty lines: indented ones are examples.
void ReadDescription(const std::string& description, Command* command) {
  std::istringstream lines(description);
  std::getline(lines, command->summary);
  bool in_paragraph = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("  ")) {
      command->examples.push_back(line.substr(2));
    } else if (line.empty()) {
      in_paragraph = false;
    } else if (in_paragraph) {
      command->paragraphs.back() += '\n' + line;
    } else {
      command->paragraphs.push_back(line);
      in_paragraph = true;
    }
  }
}

}  // namespace

Command CommandOf(const CLI::App& parser) {
  Command command;
  command.name = parser.get_name();
  ReadDescription(parser.get_description(), &command);
  for (const CLI::Option* option : parser.get_options()) {
    Argument argument = ArgumentOf(*option);
    auto& list = argument.names.empty() ? command.positionals : command.options;
    list.push_back(std::move(argument));
  }
  for (const CLI::App* verb : parser.get_subcommands([](const CLI::App*) { return true; })) {
    command.verbs.push_back(CommandOf(*verb));
  }
  return command;
}

std::vector<std::string> EndingsOf(Files files) {
  switch (files) {
    case Files::kMesh:
      return {"ply", "obj", "stl", "off"};
    case Files::kFolp:
      return {"folp"};
    case Files::kMeshOrFolp:
      return {"ply", "obj", "stl", "off", "folp"};
    case Files::kToml:
      return {"toml"};
    case Files::kPng:
      return {"png"};
    case Files::kNone:
    case Files::kAny:
    case Files::kFolder:
      break;
  }
  return {};
}

std::string Joined(const std::vector<std::string>& words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

}  // namespace folprom::pages
