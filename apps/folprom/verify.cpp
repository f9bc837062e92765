#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/folprom/limit_flags.h"
#include "apps/folprom/options.h"
#include "apps/folprom/report.h"
#include "apps/folprom/session.h"
#include "apps/folprom/verbs.h"
#include "folprom/folprom.h"

namespace folprom::cli {
namespace {

constexpr const char* kDescription =
    "Check that a file gives back the whole mesh\n"
    "\n"
    "  folprom verify scan.folp\n"
    "  folprom verify scan.folp --against scan.ply";

struct VerifyFlags {
  CommonFlags common;
  WorkFlags work;
  LimitFlags limits;
  std::string input;
  std::string original;
};

void PrintReport(const VerifyFlags& flags, const VerifyReport& report, double seconds) {
  if (flags.common.json) {
    // Without an original nothing was measured.
    const Json error = report.against ? Json(report.max_position_error) : Json(nullptr);
    PrintJson({{"lossless", report.lossless},
               {"against", report.against},
               {"max_position_error", error},
               {"tolerance", report.tolerance},
               {"vertices", report.vertices},
               {"faces", report.faces},
               {"attributes", report.attributes},
               {"rounded_attributes", report.rounded_attributes},
               {"face_attributes", report.face_attributes},
               {"order_kept", report.order_kept},
               {"welded", report.welded},
               {"reason", report.reason},
               {"seconds", seconds},
               {"peak_rss_bytes", PeakResidentBytes()}});
  } else if (!flags.common.quiet && report.lossless) {
    std::string text =
        fmt::format("{}: lossless, {} vertices, {} faces, tolerance {:.6g}", flags.input,
                    Grouped(report.vertices), Grouped(report.faces), report.tolerance);
    if (report.against) {
      text += fmt::format(", largest error {:.6g} against {}", report.max_position_error,
                          flags.original);
      const uint64_t equal = report.attributes - report.rounded_attributes;
      if (equal > 0) text += fmt::format(", {} attributes equal", equal);
      if (report.rounded_attributes > 0) {
        text += fmt::format(", {} attributes within half a step", report.rounded_attributes);
      }
      if (report.face_attributes > 0) {
        text += fmt::format(", {} attributes of faces equal", report.face_attributes);
      }
    }
    if (report.welded) text += ", welded";
    if (report.order_kept) text += ", order kept";
    Print(text + fmt::format("; {:.1f} s\n", seconds));
  }
}

int Run(const VerifyFlags& flags) {
  DecodeOptions options;
  flags.limits.ApplyTo(&options.limits);
  options.limits.memory_bytes = flags.work.memory.value_or(options.limits.memory_bytes);
  options.temporary_folder = flags.work.temporary_folder.value_or("");
  const auto runner = MakeRunner(flags.work, flags.work.threads.value_or(0));
  Session session(flags.common);
  const VerifyReport report =
      VerifyFile(flags.input, flags.original, options, *runner, session.progress()).value();
  session.StopDisplay();
  PrintReport(flags, report, session.seconds());
  if (report.lossless) return 0;
  throw Failure(ErrorKind::kCorrupt, flags.input + ": not lossless: " + report.reason);
}

}  // namespace

Verb AddVerify(CLI::App& program) {
  auto flags = std::make_shared<VerifyFlags>();
  CLI::App* verb = program.add_subcommand("verify", kDescription);
  verb->add_option("F.folp", flags->input, "File to check")->type_name("")->required();
  verb->add_option("--against", flags->original,
                   "Compare with this mesh, not only with the digest in the file")
      ->type_name("SCAN");
  AddWorkFlags(verb, &flags->work);
  AddLimitFlag(verb, &flags->limits);
  AddCommonFlags(verb, &flags->common);
  AddProgressFlag(verb, &flags->common);
  return {verb, [flags] { return Run(*flags); }};
}

}  // namespace folprom::cli
