// folprom beside its peers: who is smaller, faster, smaller in memory, and gives back what.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "folprom/result.h"
#include "tests/bench/peers/child_process.h"
#include "tests/bench/peers/contenders.h"
#include "tests/bench/peers/curve.h"
#include "tests/bench/peers/marked_file.h"
#include "tests/bench/peers/race.h"
#include "tests/bench/peers/report.h"

namespace folprom::peers {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDescription =
    "Run folprom and programs of other packages side by side\n"
    "\n"
    "  sh tests/bench/peers.sh\n"
    "  sh tests/bench/peers.sh scan.ply --runs 5 --config configs/paper.toml\n"
    "  sh tests/bench/peers.sh --no-curves --results tests/bench/RESULTS.md\n"
    "\n"
    "Prints two Markdown tables for each scan; CSV and plots go to the output folder.";

struct Flags {
  std::vector<std::string> scans;
  std::string folprom = FOLPROM_PROGRAM;
  std::vector<std::string> configs;
  std::vector<int> bits = {12, 14, 16};
  std::vector<double> rates = {0.25, 0.5, 1, 2, 4, 8, 12};
  int runs = 5;
  bool no_race = false;
  bool no_curves = false;
  std::string output = "peers";
  std::string results;
};

// The shared scans; where they are missing a synthetic one.
std::vector<std::string> DefaultScans(const Flags& flags) {
  const char* variable = std::getenv("FOLPROM_SHARED");
  const fs::path shared =
      variable != nullptr ? fs::path(variable) : fs::path(FOLPROM_SOURCE_DIR) / "../shared";
  std::vector<std::string> scans;
  for (const char* name : {"fandisk", "venus_head", "horse", "igea", "dragon_vrip"}) {
    const fs::path scan = shared / "data/scans" / (std::string(name) + ".ply");
    if (fs::is_regular_file(scan)) scans.push_back(scan.lexically_normal().string());
  }
  if (scans.empty()) {
    scans.push_back((fs::path(flags.output) / "synthetic.ply").string());
    const Command synth = {flags.folprom, "synth", "--vertices", "200k", "-o", scans.front(), "-f"};
    if (!Execute(synth, "", "").succeeded) {
      throw Failure(ErrorKind::kInternal, flags.folprom + " synth failed");
    }
  }
  return scans;
}

ContenderOptions OptionsOf(const Flags& flags) {
  ContenderOptions options{flags.folprom, {{"", ""}}, flags.bits};
  for (const std::string& config : flags.configs) {
    options.settings.push_back({fs::path(config).stem().string(), config});
  }
  return options;
}

class Report {
 public:
  explicit Report(const Flags& flags) : flags_(flags) {}

  void Add(const Race& race) {
    Publish("peers " + race.scan, MarkdownOf(race));
    races_csv_ += CsvOf(race, races_csv_.empty());
    Write(fs::path(flags_.output) / "peers.csv", races_csv_);
  }

  void Add(const Curve& curve) {
    Publish("curve " + curve.scan, MarkdownOf(curve));
    curves_csv_ += CsvOf(curve, curves_csv_.empty());
    Write(fs::path(flags_.output) / "curves.csv", curves_csv_);
    const std::string plot = "rd_" + curve.scan + ".svg";
    Write(fs::path(flags_.output) / plot, SvgOf(curve));
    if (!flags_.results.empty()) {
      Write(fs::path(flags_.results).parent_path() / "plots" / plot, SvgOf(curve));
    }
  }

 private:
  static void Write(const fs::path& path, const std::string& text) {
    if (path.has_parent_path()) fs::create_directories(path.parent_path());
    WriteBytes(path.string(), {text.begin(), text.end()});
  }

  void Publish(const std::string& name, const std::string& markdown) {
    std::printf("%s\n", markdown.c_str());
    std::fflush(stdout);
    if (!flags_.results.empty()) ReplaceMarked(flags_.results, name, markdown);
  }

  const Flags& flags_;
  std::string races_csv_, curves_csv_;
};

// Before hours of work, not after.
void CheckResults(const Flags& flags, const std::vector<std::string>& scans) {
  if (flags.results.empty()) return;
  for (const std::string& scan : scans) {
    const std::string name = fs::path(scan).stem().string();
    if (!flags.no_race) CheckMarked(flags.results, "peers " + name);
    if (!flags.no_curves) CheckMarked(flags.results, "curve " + name);
  }
}

void Work(const Flags& flags) {
  CheckPrograms();
  fs::create_directories(flags.output);
  const std::vector<std::string> scans = flags.scans.empty() ? DefaultScans(flags) : flags.scans;
  CheckResults(flags, scans);
  const ContenderOptions options = OptionsOf(flags);
  Report report(flags);
  for (const std::string& scan : scans) {
    if (!flags.no_race) report.Add(RunRace(scan, options, flags.runs));
    if (!flags.no_curves) report.Add(MeasureCurve(scan, options, flags.rates));
  }
  std::fprintf(stderr, "written to %s\n", flags.output.c_str());
}

int Main(int argc, char** argv) {
  Flags flags;
  CLI::App program(kDescription, "peers");
  program.add_option("SCAN", flags.scans,
                     "Meshes (PLY); else the shared scans, else a synthetic one");
  program.add_option("--folprom", flags.folprom, "Program; else the one of this build");
  program
      .add_option("--config", flags.configs, "Also folprom with these settings; may be repeated")
      ->allow_extra_args(false);
  program.add_option("--bits", flags.bits, "Bits of the positions, 12,14,16; curves use the first")
      ->delimiter(',')
      ->check(CLI::Range(1, 16));
  program.add_option("--bpv", flags.rates, "Rates of the curves, 0.25,0.5,1,2,4,8,12")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  program.add_option("--runs", flags.runs, "Alternating runs, 5")->check(CLI::Range(1, 1000));
  program.add_flag("--no-race", flags.no_race, "No sizes, times and memory");
  program.add_flag("--no-curves", flags.no_curves, "No rate and distortion");
  program.add_option("-o,--output", flags.output, "Folder for CSV and plots")->take_last();
  program.add_option("--results", flags.results,
                     "Also put the tables between this file's marks, and plots beside it");
  CLI11_PARSE(program, argc, argv);
  StopOnSignals();
  Work(flags);
  return 0;
}

}  // namespace
}  // namespace folprom::peers

int main(int argc, char** argv) {
  try {
    return folprom::peers::Main(argc, argv);
  } catch (const folprom::Failure& fault) {
    std::fprintf(stderr, "peers: %s\n", fault.what());
    return static_cast<int>(fault.error().kind);
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "peers: %s\n", fault.what());
    return 1;
  }
}
