#include "apps/folprom/rd_plot.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "apps/folprom/markup.h"

namespace folprom::cli {
namespace {

// Pixels.
constexpr double kWidth = 760, kHeight = 520;
constexpr double kLeft = 82, kRight = 736, kTop = 78, kBottom = 456;

struct Style {
  const char* colour;
  double width;
  const char* dashes;
};
constexpr Style kStyles[] = {
    {"#1d5fb4", 2.6, "none"}, {"#d1541b", 1.8, "7 4"}, {"#6b7280", 1.8, "2 4"}};

// Maps a range of values to pixels by their logarithm.
class LogAxis {
 public:
  LogAxis(double first_pixel, double last_pixel) : first_(first_pixel), last_(last_pixel) {}

  void Include(double value) {
    lo_ = any_ ? std::min(lo_, value) : value;
    hi_ = any_ ? std::max(hi_, value) : value;
    any_ = true;
  }
  // Some room on both sides, so that no point lies on the frame.
  void Widen() {
    if (!any_) Include(1);
    const double room = std::max(1.12, std::pow(hi_ / lo_, 0.05));
    lo_ /= room;
    hi_ *= room;
  }
  double PixelOf(double value) const {
    return first_ + (last_ - first_) * std::log(value / lo_) / std::log(hi_ / lo_);
  }
  bool Holds(double value) const { return value >= lo_ && value <= hi_; }
  double lo() const { return lo_; }
  double hi() const { return hi_; }

 private:
  double first_, last_;
  double lo_ = 0, hi_ = 0;
  bool any_ = false;
};

std::vector<double> PowersOfTwo(const LogAxis& axis) {
  std::vector<double> ticks;
  for (int k = -20; k <= 20; ++k) {
    if (axis.Holds(std::ldexp(1, k))) ticks.push_back(std::ldexp(1, k));
  }
  return ticks;
}

// 1, 2, 5, 10, ...; over many decades only 1, 10, ...
std::vector<double> RoundNumbers(const LogAxis& axis) {
  const bool many = axis.hi() / axis.lo() > 1e4;
  std::vector<double> ticks;
  for (int k = -12; k <= 12; ++k) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      if (many && digit != 1) continue;
      const double value = k < 0 ? digit / std::pow(10, -k) : digit * std::pow(10, k);
      if (axis.Holds(value)) ticks.push_back(value);
    }
  }
  return ticks;
}

bool HasPlace(const PlotPoint& point) { return point.rate > 0 && point.error > 0; }

class Drawing {
 public:
  explicit Drawing(const RatePlot& plot) : plot_(plot) {
    for (const PlotSeries& series : plot.series) {
      for (const PlotPoint& point : series.points) {
        if (!HasPlace(point)) continue;
        x_.Include(point.rate);
        y_.Include(point.error);
      }
    }
    x_.Widen();
    y_.Widen();
  }

  std::string Text() {
    Add("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
        "height=\"{1}\" font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\" "
        "font-size=\"13\" fill=\"#1f2937\">\n",
        kWidth, kHeight);
    Add("<rect width=\"{}\" height=\"{}\" fill=\"#ffffff\"/>\n", kWidth, kHeight);
    Add("<text x=\"{}\" y=\"34\" font-size=\"18\" font-weight=\"bold\">{}</text>\n", kLeft,
        Escaped(plot_.title));
    Add("<text x=\"{}\" y=\"56\" fill=\"#4b5563\">{}</text>\n", kLeft, Escaped(plot_.subtitle));
    DrawAxes();
    // The boldest last, on top.
    for (size_t i = plot_.series.size(); i-- > 0;) DrawSeries(i);
    DrawLegend();
    return svg_ + "</svg>\n";
  }

 private:
  template <class... Arguments>
  void Add(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    svg_ += fmt::format(format, std::forward<Arguments>(arguments)...);
  }

  void DrawAxes() {
    for (const double tick : PowersOfTwo(x_)) {
      const double x = x_.PixelOf(tick);
      Add("<path d=\"M{0:.1f} {1}V{2}\" stroke=\"#e5e7eb\"/>\n", x, kTop, kBottom);
      Add("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{:g}</text>\n", x, kBottom + 20,
          tick);
    }
    for (const double tick : RoundNumbers(y_)) {
      const double y = y_.PixelOf(tick);
      Add("<path d=\"M{1} {0:.1f}H{2}\" stroke=\"#e5e7eb\"/>\n", y, kLeft, kRight);
      Add("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{:g}</text>\n", kLeft - 9, y + 4.5,
          tick);
    }
    Add("<path d=\"M{0} {1}V{2}H{3}\" fill=\"none\" stroke=\"#6b7280\"/>\n", kLeft, kTop, kBottom,
        kRight);
    Add("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">rate [bits per vertex of the "
        "original]</text>\n",
        (kLeft + kRight) / 2, kBottom + 46);
    Add("<text transform=\"translate(26 {}) rotate(-90)\" text-anchor=\"middle\">mean surface "
        "distance [10<tspan dy=\"-5\" font-size=\"10\">−4</tspan><tspan dx=\"4\" dy=\"5\">of the "
        "diagonal]</tspan></text>\n",
        (kTop + kBottom) / 2);
  }

  void DrawSeries(size_t index) {
    const Style& style = kStyles[std::min(index, std::size(kStyles) - 1)];
    std::string path;
    for (const PlotPoint& point : plot_.series[index].points) {
      if (!HasPlace(point)) continue;
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x_.PixelOf(point.rate),
                          y_.PixelOf(point.error));
    }
    if (path.empty()) return;
    DrawLine(path, style);
    for (const PlotPoint& point : plot_.series[index].points) {
      if (HasPlace(point)) DrawMark(x_.PixelOf(point.rate), y_.PixelOf(point.error), index);
    }
  }

  void DrawLine(const std::string& path, const Style& style) {
    Add("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-dasharray=\"{}\" "
        "stroke-linejoin=\"round\"/>\n",
        path, style.colour, style.width, style.dashes);
  }

  // A disc, a square or a diamond.
  void DrawMark(double x, double y, size_t index) {
    const char* colour = kStyles[std::min(index, std::size(kStyles) - 1)].colour;
    if (index == 0) {
      Add("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\" fill=\"{}\" stroke=\"#ffffff\" "
          "stroke-width=\"1.5\"/>\n",
          x, y, colour);
    } else {
      Add("<rect x=\"-4\" y=\"-4\" width=\"8\" height=\"8\" fill=\"#ffffff\" stroke=\"{}\" "
          "stroke-width=\"1.8\" transform=\"translate({:.1f} {:.1f}) rotate({})\"/>\n",
          colour, x, y, index == 1 ? 0 : 45);
    }
  }

  // Curves fall from left to right: the upper right corner is free.
  void DrawLegend() {
    constexpr double kLine = 24, kLetter = 7;
    size_t letters = 0;
    for (const PlotSeries& series : plot_.series) {
      if (!series.points.empty()) letters = std::max(letters, series.name.size());
    }
    const double width = 84 + kLetter * static_cast<double>(letters);
    const double left = kRight - width - 12;
    const auto drawn = std::count_if(plot_.series.begin(), plot_.series.end(),
                                     [](const PlotSeries& s) { return !s.points.empty(); });
    const double height = kLine * static_cast<double>(drawn) + 12;
    Add("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"5\" fill=\"#ffffff\" "
        "fill-opacity=\"0.92\" stroke=\"#d1d5db\"/>\n",
        left, kTop + 10, width, height);
    double y = kTop + 16 + kLine / 2;
    for (size_t i = 0; i < plot_.series.size(); ++i) {
      if (plot_.series[i].points.empty()) continue;
      DrawLine(fmt::format("M{} {}H{}", left + 14, y, left + 58),
               kStyles[std::min(i, std::size(kStyles) - 1)]);
      DrawMark(left + 36, y, i);
      Add("<text x=\"{}\" y=\"{}\">{}</text>\n", left + 70, y + 4.5, Escaped(plot_.series[i].name));
      y += kLine;
    }
  }

  const RatePlot& plot_;
  LogAxis x_{kLeft, kRight};
  LogAxis y_{kBottom, kTop};
  std::string svg_;
};

}  // namespace

std::string SvgOf(const RatePlot& plot) { return Drawing(plot).Text(); }

}  // namespace folprom::cli
