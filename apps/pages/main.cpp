// folprom_pages FOLDER VERSION [DATE]: writes the man pages and shell completions of folprom. A
// tool of the build.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "apps/folprom/program.h"
#include "apps/pages/command.h"
#include "apps/pages/completion.h"
#include "apps/pages/man_page.h"

namespace folprom::pages {
namespace {

void Write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path.string() + ": cannot write");
}

void WritePages(const std::filesystem::path& folder, const ManEdition& edition) {
  const cli::Program program = cli::MakeProgram();
  const Command command = CommandOf(*program.parser);
  const std::filesystem::path man = folder / "man1";
  std::filesystem::create_directories(man);
  Write(man / (command.name + ".1"), ManPage(command, edition));
  for (const Command& verb : command.verbs) {
    Write(man / (command.name + "-" + verb.name + ".1"), VerbManPage(command, verb, edition));
  }
  Write(folder / (command.name + ".bash"), BashCompletion(command));
  Write(folder / ("_" + command.name), ZshCompletion(command));
}

}  // namespace
}  // namespace folprom::pages

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::fprintf(stderr, "usage: folprom_pages FOLDER VERSION [DATE]\n");
    return 2;
  }
  try {
    folprom::pages::WritePages(argv[1], {argv[2], argc == 4 ? argv[3] : ""});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "folprom_pages: %s\n", error.what());
    return 5;
  }
  return 0;
}
