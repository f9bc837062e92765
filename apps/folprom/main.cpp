// folprom: reads the command line, runs one verb, turns every fault into a line and an exit code.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "apps/folprom/program.h"
#include "folprom/result.h"
#include "parallel/progress.h"

namespace folprom::cli {
namespace {

int Report(const Error& error) {
  std::string message = error.message;
  // One line, whatever a library put into its message.
  while (!message.empty() && message.back() == '\n') message.pop_back();
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::fprintf(stderr, "folprom: %s\n", message.c_str());
  return static_cast<int>(error.kind);
}

int ReportBug(const std::string& what) {
  return Report({ErrorKind::kInternal,
                 "internal error: " + what + "; this is a bug, please report it with the command"});
}

int Run(int argc, char** argv) {
  const Program program = MakeProgram();
  try {
    program.parser->parse(argc, argv);
  } catch (const CLI::Success& help) {
    return program.parser->exit(help);
  } catch (const CLI::ParseError& error) {
    return Report({ErrorKind::kUsage, std::string(error.what()) + " (see folprom --help)"});
  }
  std::string names;
  for (const Verb& verb : program.verbs) {
    if (verb.parser->parsed()) return verb.run();
    names += (names.empty() ? "" : ", ") + verb.parser->get_name();
  }
  return Report({ErrorKind::kUsage, "no verb given: one of " + names});
}

}  // namespace
}  // namespace folprom::cli

int main(int argc, char** argv) {
  using folprom::ErrorKind;
  using folprom::cli::Report;
  using folprom::cli::ReportBug;
  try {
    return folprom::cli::Run(argc, argv);
  } catch (const folprom::Failure& failure) {
    if (failure.error().kind == ErrorKind::kInternal) return ReportBug(failure.error().message);
    return Report(failure.error());
  } catch (const folprom::parallel::Cancelled&) {
    return Report({ErrorKind::kInterrupted, "interrupted"});
  } catch (const std::bad_alloc&) {
    return Report({ErrorKind::kLimit, "out of memory; a smaller -M or fewer threads may help"});
  } catch (const std::exception& error) {
    return ReportBug(error.what());
  }
}
