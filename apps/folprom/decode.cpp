#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>

#include "apps/folprom/limit_flags.h"
#include "apps/folprom/lod_flags.h"
#include "apps/folprom/options.h"
#include "apps/folprom/report.h"
#include "apps/folprom/session.h"
#include "apps/folprom/verbs.h"
#include "folprom/folprom.h"

namespace folprom::cli {
namespace {

constexpr const char* kDescription =
    "Decode a file, or a coarser mesh from a part of it\n"
    "\n"
    "  folprom decode scan.folp -o scan.ply\n"
    "  folprom decode scan.folp -o scan.obj\n"
    "  folprom decode scan.folp -o preview.ply --max-vertices 100k\n"
    "  folprom decode scan.folp -o coarse.ply --max-error 0.5\n"
    "  folprom decode scan.folp -o corner.ply --region 0,0,0,10,10,10";

struct DecodeFlags {
  CommonFlags common;
  WorkFlags work;
  LimitFlags limits;
  std::string input;
  std::string output;
  LodFlags lod;
  std::optional<std::string> region;
  bool force = false;
};

DecodeOptions Settings(const DecodeFlags& flags) {
  DecodeOptions options;
  flags.lod.ApplyTo(&options);
  if (flags.region) {
    auto box = ParseRegion(*flags.region);
    if (!box) throw Failure(ErrorKind::kUsage, "--region: " + box.error().message);
    options.use_region = true;
    const std::array<double, 6>& corners = *box;
    std::copy_n(corners.begin(), 3, options.region_lo);
    std::copy_n(corners.begin() + 3, 3, options.region_hi);
  }
  flags.limits.ApplyTo(&options.limits);
  options.limits.memory_bytes = flags.work.memory.value_or(options.limits.memory_bytes);
  options.temporary_folder = flags.work.temporary_folder.value_or("");
  options.overwrite = flags.force;
  return options;
}

void PrintReport(const DecodeFlags& flags, const DecodeReport& report, double seconds) {
  if (flags.common.json) {
    PrintJson({{"output", flags.output},
               {"vertices", report.vertices},
               {"faces", report.faces},
               {"seconds", seconds},
               {"peak_rss_bytes", PeakResidentBytes()},
               {"layers", report.layers},
               {"layers_total", report.layers_total},
               {"complete", report.complete},
               {"bytes_read", report.bytes_read},
               {"error_bound", report.error_bound},
               {"warnings", report.warnings}});
  } else if (!flags.common.quiet) {
    Print(fmt::format(
        "{}: {} vertices, {} faces, {}\n"
        "{} of {} layers from {} bytes, error at most {:.6g}; {:.1f} s, {} memory\n",
        flags.output, Grouped(report.vertices), Grouped(report.faces),
        report.complete ? "the whole mesh" : "a part of the mesh", Grouped(report.layers),
        Grouped(report.layers_total), Grouped(report.bytes_read), report.error_bound, seconds,
        BytesShort(PeakResidentBytes())));
  }
}

int Run(const DecodeFlags& flags) {
  const DecodeOptions options = Settings(flags);
  CheckOutput(flags.input, flags.output, flags.force);
  const auto runner = MakeRunner(flags.work, flags.work.threads.value_or(0));
  Session session(flags.common);
  const DecodeReport report =
      DecodeFile(flags.input, flags.output, options, *runner, session.progress()).value();
  session.StopDisplay();
  LogWarnings(report.warnings);
  PrintReport(flags, report, session.seconds());
  return 0;
}

}  // namespace

Verb AddDecode(CLI::App& program) {
  auto flags = std::make_shared<DecodeFlags>();
  CLI::App* verb = program.add_subcommand("decode", kDescription);
  verb->add_option("F.folp", flags->input, "File to read")->type_name("")->required();
  verb->add_option("-o,--output", flags->output, "Mesh to write: .ply, .obj, .stl or .off")
      ->type_name("OUT")
      ->required();
  verb->add_flag("-f,--force", flags->force, "May replace the output");
  AddLodFlags(verb, &flags->lod);
  verb->add_option("--region", flags->region, "Only what lies in this box, in model units")
      ->type_name("x0,y0,z0,x1,y1,z1");
  AddWorkFlags(verb, &flags->work);
  AddLimitFlag(verb, &flags->limits);
  AddCommonFlags(verb, &flags->common);
  AddProgressFlag(verb, &flags->common);
  AddRunnerFlag(verb, &flags->work);
  return {verb, [flags] { return Run(*flags); }};
}

}  // namespace folprom::cli
