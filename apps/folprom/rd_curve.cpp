#include "apps/folprom/rd_curve.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <span>

#include "apps/folprom/published_rates.h"
#include "apps/folprom/rd_plot.h"
#include "apps/folprom/session.h"
#include "io/files/atomic_file.h"

namespace folprom::cli {
namespace {

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

std::string CurveSvg(const CurveOrigin& origin, const RateCurve& curve) {
  CurvePlot plot;
  plot.scan = std::filesystem::path(origin.scan).filename().string();
  plot.label = origin.label;
  plot.vertices = curve.vertices;
  plot.faces = curve.faces;
  plot.bits_per_vertex = WholeRate(curve);
  for (const RatePoint& point : curve.points) {
    const auto relative = Relative(LargerOf(point.comparison).mean, point.comparison);
    plot.points.push_back({point.bits_per_vertex, 1e4 * relative.value_or(0)});
  }
  return SvgOf(plot);
}

}  // namespace

std::string SvgOf(const CurvePlot& curve) {
  RatePlot plot;
  plot.title = curve.scan + ": rate and distortion";
  plot.subtitle = fmt::format("{} vertices, {} faces; the whole file has {:.2f} bits per vertex",
                              Grouped(curve.vertices), Grouped(curve.faces), curve.bits_per_vertex);
  plot.series.push_back({"folprom, " + curve.label, curve.points});
  if (const PublishedScan* known = PublishedFor(curve.vertices)) {
    plot.series.push_back(PublishedSeries("FOLProM, the paper", known->paper));
    plot.series.push_back(PublishedSeries("simplify + Draco", known->simplify));
  }
  return SvgOf(plot);
}

std::vector<double> ParseRates(const std::string& text, const std::string& option) {
  std::vector<double> rates;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    double rate = 0;
    const auto [after, error] = std::from_chars(at, end, rate);
    const bool number = error == std::errc() && std::isfinite(rate) && rate > 0;
    if (!number || (after != end && *after != ',')) {
      throw Failure(ErrorKind::kUsage,
                    option + ": '" + text + "' is not a list of rates above 0 such as 0.5,1,2");
    }
    rates.push_back(rate);
    if (after == end) return rates;
    at = after + 1;
  }
}

DistanceStatistics LargerOf(const Comparison& comparison) {
  const DistanceStatistics& a = comparison.forward;
  const DistanceStatistics& b = comparison.backward;
  return {std::max(a.mean, b.mean), std::max(a.rms, b.rms), std::max(a.max, b.max)};
}

std::optional<double> Relative(double distance, const Comparison& comparison) {
  if (comparison.diagonal > 0) return distance / comparison.diagonal;
  return std::nullopt;
}

Json CurveJson(const CurveOrigin& origin, const RateCurve& curve, double seconds) {
  Json points = Json::array();
  for (const RatePoint& point : curve.points) points.push_back(PointJson(point));
  const Comparison& comparison = curve.points.front().comparison;
  return {{"scan", origin.scan},
          {"config", origin.config},
          {"bits", origin.options.bits},
          {"tolerance", origin.options.tolerance},
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

std::string CurveTable(const std::string& scan, const RateCurve& curve) {
  const PublishedScan* known = PublishedFor(curve.vertices);
  std::string table = fmt::format(
      "{}: {} vertices, {} faces; whole file {:.2f} bits per vertex\n"
      "{:>9} {:>8} {:>11} {:>11} {:>9} {:>9} {:>9}{}\n",
      scan, Grouped(curve.vertices), Grouped(curve.faces), WholeRate(curve), "asked", "bpv",
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

void WriteCurve(const std::string& prefix, const CurveOrigin& origin, const RateCurve& curve,
                const Json& json, bool force) {
  const std::string json_text = json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  const std::string texts[] = {json_text, CurveCsv(curve), CurveSvg(origin, curve)};
  for (size_t i = 0; i < std::size(texts); ++i) {
    io::WriteWholeFile(prefix + kCurveSuffixes[i], texts[i], force).value();
  }
}

}  // namespace folprom::cli
