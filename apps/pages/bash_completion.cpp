#include <spdlog/fmt/fmt.h>

#include "apps/pages/completion.h"

namespace folprom::pages {
namespace {

constexpr const char* kHead = R"(# bash completion for folprom: verbs, options, values and files.

_folprom_words() {
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$cur")
}

# Folders, and the files that have one of the endings.
_folprom_files() {
  local pattern
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(
    compgen -d -- "$cur"
    for pattern; do compgen -f -X "!$pattern" -- "$cur"; done
  )
}

_folprom() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]} verb= i
  # "--option=value" comes as three words.
  if [[ $cur == '=' ]]; then
    cur=
  elif [[ $prev == '=' ]]; then
    prev=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  for ((i = 1; i < COMP_CWORD; i++)); do
    if [[ ${COMP_WORDS[i]} != -* ]]; then
      verb=${COMP_WORDS[i]}
      break
    fi
  done
  COMPREPLY=()
)";

// "*.[pP][lL][yY]": endings are known in large letters too.
std::string Pattern(const std::string& ending) {
  std::string pattern = "*.";
  for (const char c : ending) {
    pattern += fmt::format("[{}{}]", c, static_cast<char>(c - 'a' + 'A'));
  }
  return pattern;
}

// The command that offers a value.
std::string Offer(const Argument& argument) {
  if (!argument.choices.empty()) {
    return "_folprom_words '" + Joined(argument.choices, " ") + "'";
  }
  switch (argument.files) {
    case Files::kNone:
      return "";
    case Files::kAny:
      return "_folprom_files '*'";
    default:
      break;
  }
  std::string command = "_folprom_files";
  for (const std::string& ending : EndingsOf(argument.files)) {
    command += " '" + Pattern(ending) + "'";
  }
  return command;
}

std::vector<std::string> OfferedNames(const Command& command) {
  std::vector<std::string> names;
  for (const Argument& option : command.options) {
    if (option.for_tests) continue;
    names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return names;
}

std::string VerbCase(const Command& verb) {
  std::string text = fmt::format("    {})\n      case $prev in\n", verb.name);
  for (const Argument& option : verb.options) {
    if (option.value.empty()) continue;
    const std::string offer = Offer(option);
    text += fmt::format("        {}){} ;;\n", Joined(option.names, " | "),
                        offer.empty() ? "" : " " + offer);
  }
  text += fmt::format(
      "        *)\n          if [[ $cur == -* ]]; then\n"
      "            _folprom_words '{}'\n",
      Joined(OfferedNames(verb), " "));
  // All positional arguments of a verb are of one kind.
  const std::string offer = verb.positionals.empty() ? "" : Offer(verb.positionals.front());
  if (!offer.empty()) text += fmt::format("          else\n            {}\n", offer);
  return text + "          fi\n          ;;\n      esac\n      ;;\n";
}

}  // namespace

std::string BashCompletion(const Command& program) {
  std::vector<std::string> words;
  for (const Command& verb : program.verbs) words.push_back(verb.name);
  const std::vector<std::string> names = OfferedNames(program);
  words.insert(words.end(), names.begin(), names.end());
  std::string text = kHead;
  text += fmt::format("  case $verb in\n    '') _folprom_words '{}' ;;\n", Joined(words, " "));
  for (const Command& verb : program.verbs) text += VerbCase(verb);
  return text + "  esac\n}\n\ncomplete -F _folprom " + program.name + "\n";
}

}  // namespace folprom::pages
