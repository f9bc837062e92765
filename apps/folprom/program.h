// The command line as a whole: the program, its verbs, its exit codes. Help, man pages and shell
// completions are all made of it.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "apps/folprom/verbs.h"

namespace CLI {
class App;
}

namespace folprom::cli {

struct Program {
  std::shared_ptr<CLI::App> parser;
  std::vector<Verb> verbs;  ///< in the order of the help
};

Program MakeProgram();

/// An exit code and what it means, for users.
struct ExitCode {
  int code;
  const char* meaning;
};
std::span<const ExitCode> ExitCodes();

/// What --version prints: version, format, and how the program was built.
std::string VersionText();

}  // namespace folprom::cli
