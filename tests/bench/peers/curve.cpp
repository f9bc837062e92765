#include "tests/bench/peers/curve.h"

#include <spdlog/fmt/fmt.h>

#include <cstdio>
#include <filesystem>

#include "apps/folprom/published_rates.h"
#include "apps/folprom/rd_plot.h"
#include "io/spill/spill.h"

namespace folprom::peers {
namespace {

std::string RateList(const std::vector<double>& rates) {
  return fmt::format("{}", fmt::join(rates, ","));
}

CurveSeries SeriesOf(const std::string& name, const std::vector<double>& rates,
                     const nlohmann::json& points) {
  CurveSeries series{name, {}};
  for (const double rate : rates) {
    std::optional<CurvePoint> found;
    for (const nlohmann::json& point : points) {
      if (point.at("requested").get<double>() != rate) continue;
      found = {point.at("bits_per_vertex"), 1e4 * point.at("mean_relative").get<double>(),
               point.at("faces"), point.value("position_bits", 0)};
      // The first layer of a progressive file is taken even where it does not fit.
      if (found->bits_per_vertex > rate) found.reset();
    }
    series.points.push_back(found);
  }
  return series;
}

std::string NameOf(const FolpromSetting& setting) {
  return setting.name.empty() ? "folprom" : "folprom " + setting.name;
}

cli::PlotSeries Plotted(const CurveSeries& series) {
  cli::PlotSeries plotted{series.name, {}};
  for (const auto& point : series.points) {
    if (point) plotted.points.push_back({point->bits_per_vertex, point->error});
  }
  return plotted;
}

}  // namespace

Curve MeasureCurve(const std::string& scan, const ContenderOptions& options,
                   const std::vector<double>& rates) {
  const io::SpillDirectory folder("");
  Curve curve;
  curve.scan = std::filesystem::path(scan).stem().string();
  curve.size = MeasureScan(scan);
  curve.rates = rates;
  curve.bits = options.bits.front();
  for (const FolpromSetting& setting : options.settings) {
    fmt::print(stderr, "{}: rates of {}\n", scan, NameOf(setting));
    Command command = {
        options.folprom, "rd",     scan, "--bits", std::to_string(curve.bits), "--bpv",
        RateList(rates), "--json", "-q"};
    if (!setting.config.empty()) command.insert(command.end(), {"--config", setting.config});
    const nlohmann::json json = JsonOf(command, folder.File("rd.json"));
    curve.folprom.push_back(SeriesOf(NameOf(setting), rates, json.at("points")));
    curve.samples = json.at("samples");
  }
  Command command = {PEER_ENVELOPE, scan, std::to_string(curve.samples)};
  for (const double rate : rates) command.push_back(fmt::format("{}", rate));
  const nlohmann::json json = JsonOf(command, folder.File("envelope.json"));
  curve.simplify = SeriesOf("simplify + Draco", rates, json.at("points"));
  const cli::PublishedScan* known = cli::PublishedFor(curve.size.vertices);
  for (const double rate : rates) {
    curve.paper.push_back(known != nullptr ? cli::ErrorAt(known->paper, rate) : 0);
  }
  return curve;
}

std::string SvgOf(const Curve& curve) {
  cli::PlotSeries paper{"FOLProM, the paper", {}};
  if (const cli::PublishedScan* known = cli::PublishedFor(curve.size.vertices)) {
    for (const cli::PublishedPoint& p : known->paper) {
      paper.points.push_back({p.bits_per_vertex, p.error});
    }
  }
  cli::RatePlot plot;
  plot.title = curve.scan + ": rate and distortion";
  plot.subtitle = fmt::format("{} vertices, {} faces; simplify + Draco makes a file for each rate",
                              curve.size.vertices, curve.size.faces);
  plot.series = {Plotted(curve.folprom.front()), paper, Plotted(curve.simplify)};
  return cli::SvgOf(plot);
}

}  // namespace folprom::peers
