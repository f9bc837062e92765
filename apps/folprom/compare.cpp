#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "apps/folprom/limit_flags.h"
#include "apps/folprom/options.h"
#include "apps/folprom/report.h"
#include "apps/folprom/session.h"
#include "apps/folprom/verbs.h"
#include "folprom/measure.h"

namespace folprom::cli {
namespace {

constexpr const char* kDescription =
    "Measure how far two meshes lie apart\n"
    "\n"
    "  folprom compare scan.ply preview.ply\n"
    "  folprom compare scan.ply scan.folp --json\n"
    "\n"
    "Mean, root mean square and largest distance from each surface to the nearest point of the\n"
    "other, in model units and in parts of the diagonal of A's bounding box, as METRO has them.";

struct CompareFlags {
  CommonFlags common;
  WorkFlags work;
  LimitFlags limits;
  std::string a;
  std::string b;
  std::optional<uint64_t> samples;
};

std::string DirectionText(const char* direction, const DistanceStatistics& statistics,
                          double diagonal) {
  const auto column = [&](double x) {
    return diagonal > 0 ? fmt::format("  {:<12.6g} ({:.3e})", x, x / diagonal)
                        : fmt::format("  {:<24.6g}", x);
  };
  return fmt::format("{}{}{}{}\n", direction, column(statistics.mean), column(statistics.rms),
                     column(statistics.max));
}

void PrintReport(const CompareFlags& flags, const Comparison& comparison, double seconds) {
  if (flags.common.json) {
    PrintJson({{"forward", DistanceJson(comparison.forward, comparison.diagonal)},
               {"backward", DistanceJson(comparison.backward, comparison.diagonal)},
               {"diagonal", comparison.diagonal},
               {"samples", comparison.samples},
               {"seconds", seconds},
               {"peak_rss_bytes", PeakResidentBytes()}});
  } else if (!flags.common.quiet) {
    Print(
        fmt::format("A: {}\nB: {}\n"
                    "        {:<26}{:<26}{}\n{}{}"
                    "in model units, in brackets as part of A's diagonal {:.6g}; {} samples each "
                    "way; {:.1f} s\n",
                    flags.a, flags.b, "mean", "root mean square", "largest",
                    DirectionText("A to B", comparison.forward, comparison.diagonal),
                    DirectionText("B to A", comparison.backward, comparison.diagonal),
                    comparison.diagonal, Grouped(comparison.samples), seconds));
  }
}

int Run(const CompareFlags& flags) {
  CompareOptions options;
  options.samples = flags.samples.value_or(0);
  flags.limits.ApplyTo(&options.limits);
  options.temporary_folder = flags.work.temporary_folder.value_or("");
  const auto runner = MakeRunner(flags.work, flags.work.threads.value_or(0));
  Session session(flags.common);
  const Comparison comparison =
      CompareFiles(flags.a, flags.b, options, *runner, session.progress()).value();
  session.StopDisplay();
  PrintReport(flags, comparison, session.seconds());
  return 0;
}

}  // namespace

Verb AddCompare(CLI::App& program) {
  auto flags = std::make_shared<CompareFlags>();
  CLI::App* verb = program.add_subcommand("compare", kDescription);
  verb->add_option("A", flags->a, "Original (mesh file or .folp)")->type_name("")->required();
  verb->add_option("B", flags->b, "Mesh to compare with it (mesh file or .folp)")
      ->type_name("")
      ->required();
  AddCountOption(verb, "--samples", &flags->samples,
                 "Points on the area of each mesh; else ten per face, 500k .. 10M");
  AddThreadFlags(verb, &flags->work);
  AddLimitFlag(verb, &flags->limits);
  AddCommonFlags(verb, &flags->common);
  AddProgressFlag(verb, &flags->common);
  AddRunnerFlag(verb, &flags->work);
  return {verb, [flags] { return Run(*flags); }};
}

}  // namespace folprom::cli
