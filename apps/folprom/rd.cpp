#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

#include "apps/folprom/config.h"
#include "apps/folprom/options.h"
#include "apps/folprom/published_rates.h"
#include "apps/folprom/rd_plot.h"
#include "apps/folprom/report.h"
#include "apps/folprom/session.h"
#include "apps/folprom/verbs.h"
#include "folprom/measure.h"
#include "io/files/atomic_file.h"

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

constexpr const char* kSuffixes[] = {".json", ".csv", ".svg"};

struct RdFlags {
  CommonFlags common;
  WorkFlags work;
  std::string scan;
  std::string config;
  std::optional<uint32_t> bits;
  std::string rates = "0.25,0.5,1,2,4,8,12,16";
  std::optional<uint64_t> samples;
  std::string output;
  bool force = false;
};

std::vector<double> ParseRates(const std::string& text) {
  std::vector<double> rates;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    double rate = 0;
    const auto [after, error] = std::from_chars(at, end, rate);
    const bool number = error == std::errc() && std::isfinite(rate) && rate > 0;
    if (!number || (after != end && *after != ',')) {
      throw Failure(ErrorKind::kUsage,
                    "--bpv: '" + text + "' is not a list of rates above 0 such as 0.5,1,2");
    }
    rates.push_back(rate);
    if (after == end) return rates;
    at = after + 1;
  }
}

EncodeConfig Settings(const RdFlags& flags) {
  EncodeConfig config;
  if (!flags.config.empty()) ReadConfig(flags.config, &config).value();
  if (flags.bits) {
    config.options.bits = *flags.bits;
    config.options.tolerance = 0;
  }
  if (flags.work.threads) config.threads = *flags.work.threads;
  if (flags.work.temporary_folder) config.options.temporary_folder = *flags.work.temporary_folder;
  CheckConfig(config).value();
  return config;
}

DistanceStatistics LargerOf(const Comparison& comparison) {
  const DistanceStatistics& a = comparison.forward;
  const DistanceStatistics& b = comparison.backward;
  return {std::max(a.mean, b.mean), std::max(a.rms, b.rms), std::max(a.max, b.max)};
}

// Part of the diagonal; a single point has none.
std::optional<double> Relative(double distance, const Comparison& comparison) {
  if (comparison.diagonal > 0) return distance / comparison.diagonal;
  return std::nullopt;
}

Json PointJson(const RatePoint& point) {
  const double diagonal = point.comparison.diagonal;
  Json json = {{"bits_per_vertex", point.bits_per_vertex},
               {"requested", point.requested},
               {"bytes", point.bytes},
               {"layers", point.layers},
               {"vertices", point.vertices},
               {"faces", point.faces}};
  json.update(DistanceJson(LargerOf(point.comparison), diagonal));
  json["forward"] = DistanceJson(point.comparison.forward, diagonal);
  json["backward"] = DistanceJson(point.comparison.backward, diagonal);
  return json;
}

double WholeRate(const RateCurve& curve) {
  return 8 * static_cast<double>(curve.bytes) / static_cast<double>(curve.vertices);
}

Json CurveJson(const RdFlags& flags, const EncodeConfig& config, const RateCurve& curve,
               double seconds) {
  Json points = Json::array();
  for (const RatePoint& point : curve.points) points.push_back(PointJson(point));
  const Comparison& comparison = curve.points.front().comparison;
  return {{"scan", flags.scan},
          {"config", flags.config},
          {"bits", config.options.bits},
          {"tolerance", config.options.tolerance},
          {"vertices", curve.vertices},
          {"faces", curve.faces},
          {"bytes", curve.bytes},
          {"bits_per_vertex", WholeRate(curve)},
          {"diagonal", comparison.diagonal},
          {"samples", comparison.samples},
          {"points", points},
          {"warnings", curve.warnings},
          {"seconds", seconds},
          {"peak_rss_bytes", PeakResidentBytes()}};
}

std::string CurveCsv(const RateCurve& curve) {
  std::string csv =
      "requested,bits_per_vertex,bytes,layers,vertices,faces,mean,rms,max,mean_relative,"
      "forward_mean,forward_rms,forward_max,backward_mean,backward_rms,backward_max\n";
  for (const RatePoint& point : curve.points) {
    const DistanceStatistics larger = LargerOf(point.comparison);
    const DistanceStatistics& forward = point.comparison.forward;
    const DistanceStatistics& backward = point.comparison.backward;
    const auto relative = Relative(larger.mean, point.comparison);
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", point.requested,
                       point.bits_per_vertex, point.bytes, point.layers, point.vertices,
                       point.faces, larger.mean, larger.rms, larger.max,
                       relative ? fmt::format("{}", *relative) : "", forward.mean, forward.rms,
                       forward.max, backward.mean, backward.rms, backward.max);
  }
  return csv;
}

PlotSeries PublishedSeries(const char* name, std::span<const PublishedPoint> points) {
  PlotSeries series{name, {}};
  for (const PublishedPoint& p : points) series.points.push_back({p.bits_per_vertex, p.error});
  return series;
}

std::string CurveSvg(const RdFlags& flags, const RateCurve& curve) {
  const std::filesystem::path config(flags.config.empty() ? "default" : flags.config);
  RatePlot plot;
  plot.title = std::filesystem::path(flags.scan).filename().string() + ": rate and distortion";
  plot.subtitle = fmt::format("{} vertices, {} faces; the whole file has {:.2f} bits per vertex",
                              Grouped(curve.vertices), Grouped(curve.faces), WholeRate(curve));
  PlotSeries own{"folprom, " + config.stem().string(), {}};
  for (const RatePoint& point : curve.points) {
    const auto relative = Relative(LargerOf(point.comparison).mean, point.comparison);
    own.points.push_back({point.bits_per_vertex, 1e4 * relative.value_or(0)});
  }
  plot.series.push_back(own);
  if (const PublishedScan* known = PublishedFor(curve.vertices)) {
    plot.series.push_back(PublishedSeries("FOLProM, the paper", known->paper));
    plot.series.push_back(PublishedSeries("simplify + Draco", known->simplify));
  }
  return SvgOf(plot);
}

std::string CurveTable(const RdFlags& flags, const RateCurve& curve) {
  const PublishedScan* known = PublishedFor(curve.vertices);
  std::string table = fmt::format(
      "{}: {} vertices, {} faces; whole file {:.2f} bits per vertex\n"
      "{:>9} {:>8} {:>11} {:>11} {:>9} {:>9} {:>9}{}\n",
      flags.scan, Grouped(curve.vertices), Grouped(curve.faces), WholeRate(curve), "asked", "bpv",
      "vertices", "faces", "mean", "rms", "max", known ? "     paper  simplify + Draco" : "");
  const auto published = [](double error) {
    return error > 0 ? fmt::format("{:g}", error) : std::string("-");
  };
  for (const RatePoint& point : curve.points) {
    const DistanceStatistics larger = LargerOf(point.comparison);
    const auto column = [&](double distance) {
      return 1e4 * Relative(distance, point.comparison).value_or(0);
    };
    table +=
        fmt::format("{:>9g} {:>8.3f} {:>11} {:>11} {:>9.3f} {:>9.3f} {:>9.2f}", point.requested,
                    point.bits_per_vertex, Grouped(point.vertices), Grouped(point.faces),
                    column(larger.mean), column(larger.rms), column(larger.max));
    if (known) {
      table += fmt::format(" {:>9} {:>17}", published(ErrorAt(known->paper, point.requested)),
                           published(ErrorAt(known->simplify, point.requested)));
    }
    table += "\n";
  }
  return table + "mean, rms and max distance in 1e-4 of the bounding-box diagonal\n";
}

void WriteFile(const std::string& path, const std::string& text, bool force) {
  const auto file = std::move(io::AtomicFile::Create(path, force).value());
  file->Append({reinterpret_cast<const uint8_t*>(text.data()), text.size()}).value();
  file->Commit().value();
}

int Run(const RdFlags& flags) {
  const EncodeConfig config = Settings(flags);
  const std::vector<double> rates = ParseRates(flags.rates);
  if (!flags.output.empty()) {
    for (const char* suffix : kSuffixes)
      CheckOutput(flags.scan, flags.output + suffix, flags.force);
  }
  const auto runner = MakeRunner(flags.work, config.threads);
  Session session(flags.common);
  const RateCurve curve = MeasureRates(flags.scan, config.options, rates, flags.samples.value_or(0),
                                       *runner, session.progress())
                              .value();
  session.StopDisplay();
  LogWarnings(curve.warnings);
  const Json json = CurveJson(flags, config, curve, session.seconds());
  if (!flags.output.empty()) {
    const std::string json_text = json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    WriteFile(flags.output + ".json", json_text, flags.force);
    WriteFile(flags.output + ".csv", CurveCsv(curve), flags.force);
    WriteFile(flags.output + ".svg", CurveSvg(flags, curve), flags.force);
  }
  if (flags.common.json) {
    PrintJson(json);
  } else if (!flags.common.quiet) {
    Print(CurveTable(flags, curve));
  }
  return 0;
}

}  // namespace

Verb AddRd(CLI::App& program) {
  auto flags = std::make_shared<RdFlags>();
  CLI::App* verb = program.add_subcommand("rd", kDescription);
  verb->add_option("SCAN", flags->scan, "Mesh to encode: PLY, OBJ, STL or OFF")->type_name("")->required();
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
  AddCommonFlags(verb, &flags->common);
  AddRunnerFlag(verb, &flags->work);
  return {verb, [flags] { return Run(*flags); }};
}

}  // namespace folprom::cli
