#include <spdlog/fmt/fmt.h>

#include <string_view>

#include "apps/pages/completion.h"

namespace folprom::pages {
namespace {

// Text inside single quotes of the shell, where _arguments takes `special` characters for its own.
std::string Quoted(std::string_view text, std::string_view special) {
  std::string quoted;
  for (const char c : text) {
    if (c == '\'') {
      quoted += "'\\''";
      continue;
    }
    if (c == '\\' || special.find(c) != std::string_view::npos) quoted += '\\';
    quoted += c;
  }
  return quoted;
}

// What comes after the message of an argument.
std::string Action(const Argument& argument) {
  if (!argument.choices.empty()) return fmt::format("({})", Joined(argument.choices, " "));
  switch (argument.files) {
    case Files::kNone:
      return " ";
    case Files::kAny:
      return "_files";
    case Files::kFolder:
      return "_files -/";
    default:
      break;
  }
  // One ending in parentheses would be flags of the pattern.
  const std::vector<std::string> endings = EndingsOf(argument.files);
  const std::string ending =
      endings.size() == 1 ? endings.front() : fmt::format("({})", Joined(endings, "|"));
  return fmt::format("_files -g \"(#i)*.{}\"", ending);
}

std::string Value(const Argument& argument) {
  return fmt::format(":{}:{}", Quoted(argument.value, ":"), Action(argument));
}

// '(-o --output)'{-o+,--output=}'[File to write]:F.folp:_files ...'
std::string OptionSpec(const Argument& option) {
  // After these nothing else is of use.
  const bool alone = option.names.back() == "--help" || option.names.back() == "--version";
  std::vector<std::string> excluded = option.names;
  excluded.insert(excluded.end(), option.excludes.begin(), option.excludes.end());
  std::string text = fmt::format("'({})'", alone ? "- *" : Joined(excluded, " "));
  std::vector<std::string> names;
  for (const std::string& name : option.names) {
    const bool is_long = name.starts_with("--");
    names.push_back(name + (option.value.empty() ? "" : is_long ? "=" : "+"));
  }
  text += names.size() == 1 ? names.front() : fmt::format("{{{}}}", Joined(names, ","));
  return text + fmt::format("'[{}]{}'", Quoted(option.text, "[]"),
                            option.value.empty() ? "" : Value(option));
}

std::string Arguments(const Command& command, const std::string& indent) {
  std::string text;
  for (const Argument& option : command.options) {
    if (!option.for_tests) text += " \\\n" + indent + OptionSpec(option);
  }
  int place = 0;
  for (const Argument& positional : command.positionals) {
    text += fmt::format(" \\\n{}'{}{}'", indent, ++place, Value(positional));
  }
  return text;
}

}  // namespace

std::string ZshCompletion(const Command& program) {
  std::string text = fmt::format(
      "#compdef {0}\n# zsh completion for {0}: verbs, options, values and files.\n\n"
      "_{0}() {{\n  local curcontext=\"$curcontext\" state line\n  typeset -A opt_args\n"
      "  local -a verbs=(\n",
      program.name);
  for (const Command& verb : program.verbs) {
    text += fmt::format("    '{}:{}'\n", verb.name, Quoted(verb.summary, ":"));
  }
  text += "  )\n  _arguments -C" + Arguments(program, "    ") +
          " \\\n    '1:verb:->verb' \\\n    '*::argument:->argument' && return\n"
          "  case $state in\n    verb) _describe verb verbs ;;\n    argument)\n"
          "      case $words[1] in\n";
  for (const Command& verb : program.verbs) {
    text += fmt::format("        {})\n          _arguments{}\n          ;;\n", verb.name,
                        Arguments(verb, "            "));
  }
  return text + fmt::format("      esac\n      ;;\n  esac\n}}\n\n_{} \"$@\"\n", program.name);
}

}  // namespace folprom::pages
