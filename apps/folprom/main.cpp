// folprom: reads the command line, runs one verb, turns every fault into a line and an exit code.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <string>

#include "apps/folprom/verbs.h"
#include "folprom/result.h"
#include "parallel/progress.h"

namespace folprom::cli {
namespace {

constexpr const char* kDescription =
    "Progressive, lossless compression of triangle meshes\n"
    "\n"
    "  folprom encode scan.ply -o scan.folp\n"
    "  folprom info scan.folp\n"
    "  folprom decode scan.folp -o preview.ply --max-vertices 100k\n"
    "  folprom decode scan.folp -o scan.ply\n"
    "  folprom verify scan.folp --against scan.ply\n"
    "  folprom compare scan.ply preview.ply\n"
    "  folprom rd scan.ply -o curve\n"
    "  folprom batch scans.toml\n"
    "  folprom render scan.folp --sheet -o lods.png\n"
    "  folprom synth --vertices 10M -o scan.ply";

constexpr const char* kFooter =
    "Exit codes: 0 done, 2 usage, 3 input, 4 encoded data corrupt, 5 output or disk,\n"
    "6 limit exceeded, 70 bug, 130 interrupted";

class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_description(const CLI::App* app) const override {
    return app->get_description() + "\n\n";
  }

  // The list of verbs shows what each is for, not its examples.
  std::string make_subcommand(const CLI::App* verb) const override {
    const std::string description = verb->get_description();
    return "  " + verb->get_name() + std::string(10 - verb->get_name().size(), ' ') +
           description.substr(0, description.find('\n')) + "\n";
  }

  // Only what the value is; ranges stand in the text, conflicts are told when they occur.
  std::string make_option_opts(const CLI::Option* option) const override {
    const std::string type = option->get_type_name();
    return " " + type.substr(0, type.find(':')) + (option->get_required() ? " (required)" : "");
  }
};

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
  CLI::App program(kDescription, "folprom");
  program.formatter(std::make_shared<HelpFormatter>());
  program.footer(kFooter);
  program.set_version_flag("--version", "folprom " FOLPROM_VERSION);
  program.require_subcommand(0, 1);
  const Verb verbs[] = {AddEncode(program), AddDecode(program),  AddInfo(program),
                        AddVerify(program), AddCompare(program), AddRd(program),
                        AddBatch(program),  AddRender(program),  AddSynth(program)};
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return program.exit(help);
  } catch (const CLI::ParseError& error) {
    return Report({ErrorKind::kUsage, std::string(error.what()) + " (see folprom --help)"});
  }
  for (const Verb& verb : verbs) {
    if (verb.parser->parsed()) return verb.run();
  }
  return Report({ErrorKind::kUsage,
                 "no verb given: encode, decode, info, verify, compare, rd, batch, render or "
                 "synth"});
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
