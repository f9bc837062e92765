#include "apps/batch/batch_page.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "apps/batch/page_style.h"
#include "apps/batch/scan_results.h"
#include "apps/folprom/markup.h"
#include "apps/folprom/rd_curve.h"
#include "apps/folprom/report.h"
#include "io/files/atomic_file.h"

namespace folprom::batch {
namespace {

using cli::BytesShort;
using cli::Escaped;
using cli::Grouped;

constexpr const char* kNothing = "–";

std::string Duration(double seconds) {
  if (seconds < 100) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<uint64_t>(seconds + 0.5);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

std::string Percent(uint64_t part, uint64_t whole) {
  return fmt::format("{:.1f} %", 100 * static_cast<double>(part) / static_cast<double>(whole));
}

std::string FileName(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

struct StateText {
  const char* text;
  const char* style;
};

StateText Describe(Status status) {
  switch (status) {
    case Status::kDone:
      return {"done", "good"};
    case Status::kUpToDate:
      return {"up to date", "good"};
    case Status::kFailed:
      return {"failed", "bad"};
    case Status::kInterrupted:
      return {"interrupted", "wait"};
    case Status::kNotRun:
      break;
  }
  return {"not run", "wait"};
}

std::string State(Status status) {
  const StateText state = Describe(status);
  return fmt::format("<span class=\"state {}\">{}</span>", state.style, state.text);
}

std::string StateCell(Status status, const std::string& reason) {
  std::string cell = "<td class=\"text\" data-label=\"state\">" + State(status);
  if (!reason.empty() && reason != Describe(status).text) {
    const std::string_view why = status == Status::kDone ? "why: " : "";
    cell += fmt::format(" <span class=\"muted\">{}{}</span>", why, Escaped(reason));
  }
  return cell + "</td>";
}

// A cell of a table; without a value it is left out on narrow screens.
std::string Cell(std::string_view label, const std::string& html) {
  return fmt::format("<td data-label=\"{}\"{}>{}</td>", label,
                     html.empty() ? " class=\"empty\"" : "", html.empty() ? kNothing : html);
}

std::string Verified(const ScanResults& scan) {
  const OperationResult* verify = Find(scan, Operation::kVerify);
  if (verify == nullptr || !verify->verified) return "";
  return *verify->verified ? "<span class=\"state good\">lossless</span>"
                           : "<span class=\"state bad\">not lossless</span>";
}

// The lines of one operation in its table, and its error below.
std::string OperationRow(const OperationResult& result) {
  const bool there = IsThere(result);
  std::string name(NameOf(result.operation));
  if (!result.lod.empty()) name += ", " + result.lod;
  const std::string about =
      result.operation == Operation::kEncode || result.operation == Operation::kRd ? result.settings
                                                                                   : "";
  std::string row = "<tr><td>" + Escaped(name);
  if (!about.empty()) row += " <span class=\"muted\">" + Escaped(about) + "</span>";
  row += "</td>" + StateCell(result.status, result.reason);
  const auto count = [&](uint64_t n) { return there && n > 0 ? Grouped(n) : std::string(); };
  const auto bytes = [](uint64_t n) { return n > 0 ? BytesShort(n) : std::string(); };
  row += Cell("vertices", count(result.vertices)) + Cell("faces", count(result.faces)) +
         Cell("written", bytes(result.output_bytes)) +
         Cell("error bound",
              there && result.error_bound ? fmt::format("{:.4g}", *result.error_bound) : "") +
         Cell("time", result.seconds > 0 ? Duration(result.seconds) : "") +
         Cell("peak memory", bytes(result.peak_memory_bytes)) + "</tr>\n";
  if (!result.error.empty()) {
    row += "<tr><td class=\"error\" colspan=\"8\">" + Escaped(result.error) + "</td></tr>\n";
  }
  return row;
}

std::string Picture(const PagePicture& picture) {
  std::string html = "<figure>";
  if (picture.png.empty()) {
    html += "<div class=\"missing\">" + Escaped(picture.problem) + "</div>";
  } else {
    html += fmt::format("<img alt=\"{}\" src=\"{}\">", Escaped(picture.title),
                        cli::PngAddress(picture.png));
  }
  return html + fmt::format("<figcaption><b>{}</b><br>{}</figcaption></figure>\n",
                            Escaped(picture.title), Escaped(picture.caption));
}

std::string Plot(const OperationResult& result) {
  cli::CurvePlot plot;
  plot.scan = FileName(result.scan);
  plot.label = result.settings;
  plot.vertices = result.vertices;
  plot.faces = result.faces;
  plot.bits_per_vertex = result.bits_per_vertex;
  for (const RdPoint& point : result.points) {
    plot.points.push_back({point.bits_per_vertex, 1e4 * point.mean_relative.value_or(0)});
  }
  std::string svg = cli::SvgOf(plot);
  // Inside HTML it needs no name space, and without it the page names no address at all.
  constexpr std::string_view kNameSpace = " xmlns=\"http://www.w3.org/2000/svg\"";
  if (const size_t at = svg.find(kNameSpace); at != std::string::npos) {
    svg.erase(at, kNameSpace.size());
  }
  return svg;
}

std::string RateTable(const OperationResult& result) {
  std::string html =
      "<table class=\"operations\"><thead><tr><th>asked for</th><th>bits per vertex</th>"
      "<th>vertices</th><th>mean error</th><th>largest</th></tr></thead><tbody>\n";
  for (const RdPoint& point : result.points) {
    html += fmt::format("<tr><td>{:g} bpv</td>", point.requested) +
            Cell("bits per vertex", fmt::format("{:.2f}", point.bits_per_vertex)) +
            Cell("vertices", Grouped(point.vertices)) +
            Cell("mean error", fmt::format("{:.3g}", point.mean)) +
            Cell("largest", fmt::format("{:.3g}", point.max)) + "</tr>\n";
  }
  return html + "</tbody></table><p class=\"muted\">distances in model units</p>\n";
}

class Page {
 public:
  Page(const BatchReport& report, const std::vector<std::vector<PagePicture>>& pictures)
      : report_(report), pictures_(pictures), scans_(ByScan(report)) {
    for (const ScanResults& scan : scans_) several_jobs_ |= scan.job != scans_.front().job;
  }

  std::string Text() {
    const std::string title = FileName(report_.job_file);
    html_ =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
        "img-src data:; style-src 'unsafe-inline'\">\n<link rel=\"icon\" href=\"data:,\">\n";
    html_ += "<title>" + Escaped(title) + " – batch report</title>\n<style>";
    html_ += kPageStyle;
    html_ += "</style>\n</head>\n<body>\n<main>\n";
    AddHead(title);
    AddErrors();
    AddTable();
    if (!scans_.empty()) html_ += "<h2>Scan by scan</h2>\n";
    for (size_t i = 0; i < scans_.size(); ++i) AddScan(i);
    html_ +=
        fmt::format("<footer>{}, file format {}; job file {}</footer>\n", Escaped(report_.program),
                    report_.format_version, Escaped(report_.job_file));
    return html_ + "</main>\n</body>\n</html>\n";
  }

 private:
  std::string NameOfScan(const ScanResults& scan) const {
    return several_jobs_ ? scan.job + ": " + scan.scan : scan.scan;
  }

  void AddFigure(const char* name, const std::string& value) {
    html_ += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", name, Escaped(value));
  }

  void AddHead(const std::string& title) {
    html_ += "<h1>" + Escaped(title) + "</h1>\n";
    html_ += fmt::format("<p class=\"muted\">{} · {} · {} threads, {} of memory</p>\n",
                         Escaped(report_.program), Escaped(report_.started), report_.threads,
                         BytesShort(report_.memory_bytes));
    uint64_t before = 0, after = 0, vertices = 0;
    for (const ScanResults& scan : scans_) {
      const OperationResult* encode = Find(scan, Operation::kEncode);
      if (encode == nullptr || !IsThere(*encode)) continue;
      before += encode->input_bytes;
      after += encode->output_bytes;
      vertices += encode->vertices;
    }
    html_ += "<dl class=\"figures\">\n";
    AddFigure("scans done", fmt::format("{} of {}", report_.scans_done, report_.scans));
    AddFigure("failed", Grouped(report_.scans_failed));
    AddFigure("time", Duration(report_.seconds));
    if (before > 0) {
      AddFigure("before", BytesShort(before));
      AddFigure("after", BytesShort(after));
      AddFigure("share", Percent(after, before));
    }
    if (vertices > 0) {
      AddFigure("bits per vertex", fmt::format("{:.2f}", 8 * static_cast<double>(after) /
                                                             static_cast<double>(vertices)));
    }
    html_ += "</dl>\n";
  }

  void AddErrors() {
    std::string items;
    for (size_t i = 0; i < scans_.size(); ++i) {
      for (const OperationResult* result : scans_[i].operations) {
        if (result->status != Status::kFailed) continue;
        items += fmt::format("<li><a href=\"#scan-{}\">{}</a>, {}: {}</li>\n", i,
                             Escaped(NameOfScan(scans_[i])), NameOf(result->operation),
                             Escaped(result->error));
      }
    }
    if (report_.interrupted) {
      html_ +=
          "<div class=\"errors\">The batch was interrupted. The same command goes on where it "
          "was.</div>\n";
    }
    if (items.empty()) return;
    html_ +=
        "<div class=\"errors\" role=\"alert\"><b>What failed</b><ul>\n" + items + "</ul></div>\n";
  }

  void AddTable() {
    html_ += "<h2>Scans</h2>\n";
    if (scans_.empty()) {
      html_ += "<p>No scans.</p>\n";
      return;
    }
    html_ +=
        "<div class=\"card\"><table class=\"scans\"><thead><tr><th>scan</th>"
        "<th class=\"text\">state</th><th>vertices</th><th>faces</th><th>before</th>"
        "<th>after</th><th>share</th><th>bits per<br>vertex</th><th>encoding</th>"
        "<th>all</th><th>peak<br>memory</th><th>verified</th></tr></thead><tbody>\n";
    for (size_t i = 0; i < scans_.size(); ++i) html_ += ScanRow(i);
    html_ += "</tbody></table></div>\n";
  }

  std::string ScanRow(size_t index) const {
    const ScanResults& scan = scans_[index];
    double seconds = 0;
    uint64_t memory = 0;
    for (const OperationResult* result : scan.operations) {
      seconds += result->seconds;
      memory = std::max(memory, result->peak_memory_bytes);
    }
    std::string row =
        fmt::format("<tr><td><a href=\"#scan-{}\">{}</a></td>", index, Escaped(NameOfScan(scan)));
    row += StateCell(StatusOf(scan), "");
    row += EncodeCells(scan);
    row += Cell("all operations", seconds > 0 ? Duration(seconds) : "") +
           Cell("peak memory", memory > 0 ? BytesShort(memory) : "") +
           Cell("verified", Verified(scan)) + "</tr>\n";
    return row;
  }

  // From vertices to the time of encoding.
  static std::string EncodeCells(const ScanResults& scan) {
    const OperationResult* encode = Find(scan, Operation::kEncode);
    const OperationResult* known = encode != nullptr ? encode : Find(scan, Operation::kRd);
    if (known == nullptr) known = Find(scan, Operation::kVerify);
    if (known != nullptr && !IsThere(*known)) known = nullptr;
    const bool encoded = known != nullptr && known == encode;
    const auto text = [](bool there, const auto& make) { return there ? make() : std::string(); };
    const bool counts = known != nullptr && known->vertices > 0;
    return Cell("vertices", text(counts, [&] { return Grouped(known->vertices); })) +
           Cell("faces", text(counts, [&] { return Grouped(known->faces); })) +
           Cell("before", text(encoded, [&] { return BytesShort(known->input_bytes); })) +
           Cell("after", text(encoded, [&] { return BytesShort(known->output_bytes); })) +
           Cell("share", text(encoded && known->input_bytes > 0,
                              [&] { return Percent(known->output_bytes, known->input_bytes); })) +
           Cell("bits per vertex",
                text(known != nullptr && known->bits_per_vertex > 0,
                     [&] { return fmt::format("{:.2f}", known->bits_per_vertex); })) +
           Cell("encoding", text(encoded, [&] { return Duration(known->seconds); }));
  }

  void AddScan(size_t index) {
    const ScanResults& scan = scans_[index];
    html_ += fmt::format(
        "<section class=\"card scan\" id=\"scan-{}\">\n<header><h3>{}</h3>{}</header>\n", index,
        Escaped(NameOfScan(scan)), State(StatusOf(scan)));
    html_ += "<p class=\"muted\">" + Escaped(scan.operations.front()->input) + "</p>\n";
    if (index < pictures_.size() && !pictures_[index].empty()) {
      html_ += "<div class=\"pictures\">\n";
      for (const PagePicture& picture : pictures_[index]) html_ += Picture(picture);
      html_ += "</div>\n";
    }
    AddOperations(scan);
    for (const OperationResult* result : scan.operations) {
      if (result->points.empty()) continue;
      html_ += "<div class=\"plots\"><div class=\"plot\">" + Plot(*result) + "</div><div>" +
               RateTable(*result) + "</div></div>\n";
    }
    html_ += "</section>\n";
  }

  void AddOperations(const ScanResults& scan) {
    html_ +=
        "<table class=\"operations\"><thead><tr><th>operation</th><th class=\"text\">state</th>"
        "<th>vertices</th><th>faces</th><th>written</th><th>error bound</th><th>time</th>"
        "<th>peak memory</th></tr></thead><tbody>\n";
    std::string warnings;
    for (const OperationResult* result : scan.operations) {
      html_ += OperationRow(*result);
      for (const std::string& warning : result->warnings) {
        warnings += "<li>" + Escaped(warning) + "</li>\n";
      }
    }
    html_ += "</tbody></table>\n";
    if (!warnings.empty()) html_ += "<ul class=\"warnings\">\n" + warnings + "</ul>\n";
  }

  const BatchReport& report_;
  const std::vector<std::vector<PagePicture>>& pictures_;
  const std::vector<ScanResults> scans_;
  bool several_jobs_ = false;
  std::string html_;
};

}  // namespace

std::string PageOf(const BatchReport& report,
                   const std::vector<std::vector<PagePicture>>& pictures) {
  return Page(report, pictures).Text();
}

void WriteBatchPage(const BatchReport& report, const std::string& folder,
                    const std::string& temporary_folder, bool with_pictures, HashCache* hashes,
                    parallel::Runner& runner, parallel::Progress& progress) {
  std::vector<std::vector<PagePicture>> pictures;
  if (with_pictures) {
    PictureSettings settings;
    settings.folder = folder + "/pictures";
    settings.temporary_folder = temporary_folder;
    settings.memory_bytes = report.memory_bytes;
    pictures = PicturesOf(ByScan(report), settings, hashes, runner, progress);
  }
  io::WriteWholeFile(folder + "/report.html", PageOf(report, pictures), true).value();
}

}  // namespace folprom::batch
