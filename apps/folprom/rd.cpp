#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>

#include "apps/folprom/config.h"
#include "apps/folprom/limit_flags.h"
#include "apps/folprom/options.h"
#include "apps/folprom/rd_curve.h"
#include "apps/folprom/report.h"
#include "apps/folprom/session.h"
#include "apps/folprom/verbs.h"
#include "folprom/measure.h"

namespace folprom::cli {
namespace {

constexpr const char* kDescription =
    "Measure what error a mesh has at each rate\n"
    "\n"
    "  folprom rd scan.ply\n"
    "  folprom rd scan.ply --config configs/paper.toml --bpv 1,2,4,8 -o curve\n"
    "\n"
    "Encodes once, decodes as many layers as fit into each rate, and compares. An error is the\n"
    "larger of the two directions of `compare`.";

struct RdFlags {
  CommonFlags common;
  WorkFlags work;
  LimitFlags limits;
  std::string scan;
  std::string config;
  std::optional<uint32_t> bits;
  std::string rates = kDefaultRates;
  std::optional<uint64_t> samples;
  std::string output;
  bool force = false;
};

EncodeConfig Settings(const RdFlags& flags) {
  EncodeConfig config;
  if (!flags.config.empty()) ReadConfig(flags.config, &config).value();
  if (flags.bits) {
    config.options.bits = *flags.bits;
    config.options.tolerance = 0;
  }
  flags.limits.ApplyTo(&config.options.limits);
  if (flags.work.threads) config.threads = *flags.work.threads;
  if (flags.work.temporary_folder) config.options.temporary_folder = *flags.work.temporary_folder;
  CheckConfig(config).value();
  return config;
}

int Run(const RdFlags& flags) {
  const EncodeConfig config = Settings(flags);
  const std::vector<double> rates = ParseRates(flags.rates);
  if (!flags.output.empty()) {
    for (const char* suffix : kCurveSuffixes)
      CheckOutput(flags.scan, flags.output + suffix, flags.force);
  }
  const auto runner = MakeRunner(flags.work, config.threads);
  Session session(flags.common);
  const RateCurve curve = MeasureRates(flags.scan, config.options, rates, flags.samples.value_or(0),
                                       *runner, session.progress())
                              .value();
  session.StopDisplay();
  LogWarnings(curve.warnings);
  const std::string label =
      flags.config.empty() ? "default" : std::filesystem::path(flags.config).stem().string();
  const CurveOrigin origin{flags.scan, flags.config, label, config.options};
  const Json json = CurveJson(origin, curve, session.seconds());
  if (!flags.output.empty()) WriteCurve(flags.output, origin, curve, json, flags.force);
  if (flags.common.json) {
    PrintJson(json);
  } else if (!flags.common.quiet) {
    Print(CurveTable(flags.scan, curve));
  }
  return 0;
}

}  // namespace

Verb AddRd(CLI::App& program) {
  auto flags = std::make_shared<RdFlags>();
  CLI::App* verb = program.add_subcommand("rd", kDescription);
  verb->add_option("SCAN", flags->scan, "Mesh to encode: PLY, OBJ, STL or OFF")
      ->type_name("")
      ->required();
  verb->add_option("--config", flags->config, "Settings of the encoder")->type_name("C.toml");
  verb->add_option("--bits", flags->bits,
                   "Lattice of 2^N - 1 steps along the longest side; 1 .. 24")
      ->check(CLI::Range(1, 24))
      ->type_name("N");
  verb->add_option("--bpv", flags->rates,
                   "Rates in bits per vertex of the original; else " + flags->rates)
      ->type_name("R,R,...");
  AddCountOption(verb, "--samples", &flags->samples,
                 "Points on the area of each mesh; else ten per face, 500k .. 10M");
  verb->add_option("-o,--output", flags->output, "Write OUT.json, OUT.csv and a plot, OUT.svg")
      ->type_name("OUT");
  verb->add_flag("-f,--force", flags->force, "May replace the outputs");
  AddThreadFlags(verb, &flags->work);
  AddLimitFlag(verb, &flags->limits);
  AddCommonFlags(verb, &flags->common);
  AddProgressFlag(verb, &flags->common);
  AddRunnerFlag(verb, &flags->work);
  return {verb, [flags] { return Run(*flags); }};
}

}  // namespace folprom::cli
