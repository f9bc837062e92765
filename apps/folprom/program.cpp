#include "apps/folprom/program.h"

#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>

#include "io/container/file_table.h"

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

constexpr ExitCode kExitCodes[] = {
    {0, "done"},           {2, "usage"},          {3, "input"}, {4, "encoded data corrupt"},
    {5, "output or disk"}, {6, "limit exceeded"}, {70, "bug"},  {130, "interrupted"}};

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

// "Exit codes: 0 done, 2 usage, ...", in lines of at most 80 characters.
std::string Footer() {
  std::string text = "Exit codes:";
  size_t line = 0;
  for (const ExitCode& exit : kExitCodes) {
    const std::string item = fmt::format(" {} {}", exit.code, exit.meaning);
    if (exit.code != 0) text += ",";
    if (text.size() - line + item.size() > 80) {
      text += "\n" + item.substr(1);
      line = text.size() - item.size() + 1;
    } else {
      text += item;
    }
  }
  return text;
}

}  // namespace

std::span<const ExitCode> ExitCodes() { return kExitCodes; }

std::string VersionText() {
  return fmt::format("folprom {}\nfile format: version {}, written and read\nbuild: {}",
                     FOLPROM_VERSION, io::kFormatVersion, FOLPROM_BUILD);
}

Program MakeProgram() {
  Program program;
  program.parser = std::make_shared<CLI::App>(kDescription, "folprom");
  CLI::App& parser = *program.parser;
  parser.formatter(std::make_shared<HelpFormatter>());
  parser.footer(Footer());
  parser.set_help_flag("-h,--help", "Print this help");  // the verbs take it over
  parser.set_version_flag("--version", VersionText, "Print version, file format and build");
  parser.require_subcommand(0, 1);
  program.verbs = {AddEncode(parser), AddDecode(parser),  AddInfo(parser),
                   AddVerify(parser), AddCompare(parser), AddRd(parser),
                   AddBatch(parser),  AddRender(parser),  AddSynth(parser)};
  return program;
}

}  // namespace folprom::cli
