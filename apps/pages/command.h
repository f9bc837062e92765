// The command line as plain data, read from the parser: what man pages and completions tell.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace folprom::pages {

/// Files that an argument may name.
enum class Files { kNone, kAny, kFolder, kMesh, kFolp, kMeshOrFolp, kToml, kPng };

/// An option, or a positional argument where it has no names.
struct Argument {
  std::vector<std::string> names;  ///< "-o", "--output"
  std::string value;               ///< what stands for its value, "" for a flag
  std::string text;
  bool required = false;
  bool for_tests = false;             ///< nothing that a user needs
  std::vector<std::string> choices;   ///< the values it can have, where they are few
  Files files = Files::kNone;         ///< of its value
  std::vector<std::string> excludes;  ///< names of options that do not go with it
};

/// The program, or one of its verbs.
struct Command {
  std::string name;
  std::string summary;                  ///< one line
  std::vector<std::string> examples;    ///< command lines
  std::vector<std::string> paragraphs;  ///< what else the description says, in its lines
  std::vector<Argument> options;
  std::vector<Argument> positionals;
  std::vector<Command> verbs;
};

Command CommandOf(const CLI::App& parser);

/// Endings without the point, in small letters; none for kNone, kAny and kFolder.
std::vector<std::string> EndingsOf(Files files);

/// Words with `separator` between them.
std::string Joined(const std::vector<std::string>& words, const std::string& separator);

}  // namespace folprom::pages
