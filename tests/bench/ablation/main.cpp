// Each technique of the paper off and on: two Markdown tables, and whether each moves as claimed.
#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/folprom/config.h"
#include "io/files/atomic_file.h"
#include "parallel/runner.h"
#include "tests/bench/ablation/experiments.h"
#include "tests/support/files.h"
#include "tests/support/ply.h"
#include "tests/support/surfaces.h"

namespace folprom::bench {
namespace {

constexpr double kRates[] = {1, 2, 4, 8, 12};

/// A scan by name, and how far all is.
struct Scan {
  std::string name;
  std::string path;
};

class Steps {
 public:
  explicit Steps(size_t all) : all_(all) {}
  void Begin(const std::string& scan, const std::string& what) {
    const auto now = std::chrono::steady_clock::now() - begin_;
    fmt::print(stderr, "[{:2}/{}, {:5.0f} s] {}: {}\n", ++done_, all_,
               std::chrono::duration<double>(now).count(), scan, what);
  }

 private:
  size_t done_ = 0, all_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

std::string Percent(double ratio) { return fmt::format("{:+.1f} %", 100 * (ratio - 1)); }
/// With the technique over without. Half a percent either way is no movement.
const char* Verdict(double ratio) {
  constexpr double kSame = 0.005;
  if (ratio < 1 - kSame) return "yes";
  return ratio > 1 + kSame ? "**no**" : "no change";
}

EncodeOptions With(EncodeOptions options, TurnOff turn_off) {
  turn_off(options.codec);
  return options;
}

std::string RateRow(const RateExperiment& experiment, const Scan& scan, const Curve& on,
                    const Curve& off) {
  std::string texts[2];
  double logarithms = 0;
  int compared = 0, lower = 0;
  for (double rate : kRates) {
    const auto with = on.At(rate, experiment.error), without = off.At(rate, experiment.error);
    const std::optional<double> errors[2] = {with, without};
    for (size_t i = 0; i < 2; ++i) {
      texts[i] += texts[i].empty() ? "" : " ";
      texts[i] += errors[i] ? fmt::format("{:.3g}", *errors[i]) : "-";
    }
    if (!with || !without) continue;
    logarithms += std::log(*with / *without);
    ++compared;
    if (*with < *without) ++lower;
  }
  const double ratio = compared > 0 ? std::exp(logarithms / compared) : 1;
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} ({} of {}) |\n", experiment.technique,
                     scan.name, experiment.claim, experiment.error_name, texts[1], texts[0],
                     Percent(ratio), Verdict(ratio), lower, compared);
}

std::string BitRow(const BitExperiment& experiment, const Scan& scan, const Costs& on,
                   const Costs& off) {
  const auto with = experiment.bits(on), without = experiment.bits(off);
  const double own = with.own / without.own, plain = with.plain / without.plain;
  return fmt::format(
      "| {} | {} | {} | {} | {:.3f} | {:.3f} | {} | {} | {:.3f} | {:.3f} | {} | {} |\n",
      experiment.technique, scan.name, experiment.claim, experiment.unit, without.own, with.own,
      Percent(own), Verdict(own), without.plain, with.plain, Percent(plain), Verdict(plain));
}

std::string RateTable(const std::vector<Scan>& scans, const EncodeOptions& base, Steps& steps,
                      parallel::Runner& runner) {
  std::vector<Curve> on;
  const auto measure = [&](const Scan& scan, const EncodeOptions& options) {
    return CurveOf(scan.path, options, kRates[0], kRates[std::size(kRates) - 1], runner);
  };
  for (const Scan& scan : scans) {
    steps.Begin(scan.name, "curve, all on");
    on.push_back(measure(scan, base));
  }
  std::string table =
      "| technique | mesh | claimed | error | off, at 1 2 4 8 12 bpv | on | change | moves as "
      "claimed (rates) |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const RateExperiment& experiment : RateExperiments()) {
    const EncodeOptions without = With(base, experiment.turn_off);
    for (size_t i = 0; i < scans.size(); ++i) {
      steps.Begin(scans[i].name, "curve without " + experiment.technique);
      table += RateRow(experiment, scans[i], on[i], measure(scans[i], without));
    }
  }
  return table;
}

std::string BitTable(const std::vector<Scan>& scans, const EncodeOptions& base, Steps& steps,
                     parallel::Runner& runner) {
  std::vector<Costs> on;
  for (const Scan& scan : scans) {
    steps.Begin(scan.name, "bits, all on");
    on.push_back(CostsOf(scan.path, base, runner));
  }
  std::string table =
      "| technique | mesh | claimed | measured | off | on | change | moves as claimed | plain off "
      "| plain on | change | moves as claimed "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const BitExperiment& experiment : BitExperiments()) {
    const EncodeOptions without = With(base, experiment.turn_off);
    for (size_t i = 0; i < scans.size(); ++i) {
      steps.Begin(scans[i].name, "bits without " + experiment.technique);
      table += BitRow(experiment, scans[i], on[i], CostsOf(scans[i].path, without, runner));
    }
  }
  return table;
}

std::vector<Scan> Scans(const std::vector<std::string>& given, const std::string& folder) {
  std::vector<Scan> scans;
  for (const std::string& path : given) {
    scans.push_back({std::filesystem::path(path).stem().string(), path});
  }
  if (given.empty()) {
    for (const char* name : {"fandisk", "horse", "igea"}) {
      const std::string path = support::SharedFile("scans/" + std::string(name) + ".ply");
      if (path.empty()) {
        fmt::print(stderr, "{} left out: {}\n", name, support::kNoSharedData);
      } else {
        scans.push_back({name, path});
      }
    }
  }
  scans.push_back({"torus", folder + "/torus.ply"});
  support::WritePly(scans.back().path, support::Torus(200, 100), support::CoordinateType::kFloat);
  return scans;
}

void Run(const std::string& config_path, const std::string& output,
         const std::vector<std::string>& given) {
  cli::EncodeConfig config;
  cli::ReadConfig(config_path, &config).value();
  const support::TemporaryFolder folder;
  const std::vector<Scan> scans = Scans(given, folder.path());
  const auto runner = parallel::MakeTbbRunner(static_cast<int>(config.threads));
  Steps steps(scans.size() * (2 + RateExperiments().size() + BitExperiments().size()));
  const std::string bits = BitTable(scans, config.options, steps, *runner);
  const std::string rates = RateTable(scans, config.options, steps, *runner);
  const std::string text = "Error at equal rates, 1e-4 of the diagonal:\n\n" + rates +
                           "\nBits, under the coder's own contexts and for a plain coder:\n\n" +
                           bits;
  fmt::print("{}", text);
  if (output.empty()) return;
  auto file = std::move(io::AtomicFile::Create(output, true).value());
  file->Append({reinterpret_cast<const uint8_t*>(text.data()), text.size()}).value();
  file->Commit().value();
}

}  // namespace
}  // namespace folprom::bench

int main(int argc, char** argv) {
  CLI::App program("Measure each technique of the paper off and on");
  std::string config, output;
  std::vector<std::string> scans;
  program.add_option("--config", config, "Settings with every technique on")->required();
  program.add_option("-o,--output", output, "Write the tables here too (Markdown)");
  program.add_option("SCAN", scans, "Scans beside the torus; else fandisk, horse, igea");
  CLI11_PARSE(program, argc, argv);
  try {
    folprom::bench::Run(config, output, scans);
  } catch (const std::exception& error) {
    fmt::print(stderr, "ablation: {}\n", error.what());
    return 1;
  }
  return 0;
}
