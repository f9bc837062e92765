#include "tests/bench/peers/report.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace folprom::peers {
namespace {

// 437,645
std::string Grouped(uint64_t number) {
  const std::string digits = std::to_string(number);
  std::string text;
  for (size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

double PerVertex(uint64_t amount, const ScanSize& size) {
  return static_cast<double>(amount) / static_cast<double>(size.vertices);
}

std::string BitsOf(int bits) { return bits > 0 ? std::to_string(bits) : "float"; }

std::string Ratio(const Cost& cost) {
  return cost.ratio > 0 ? fmt::format("{:.2f}", cost.ratio) : "-";
}

std::string Mebibytes(const Cost& cost) {
  return fmt::format("{:.0f}", static_cast<double>(cost.peak_bytes) / (1 << 20));
}

// "all", or how many came out and how many of the original are not among them.
std::string CameBack(bool same, uint64_t decoded, uint64_t lost) {
  if (same) return "all";
  return fmt::format("{}, {} lost", Grouped(decoded), Grouped(lost));
}

std::string OrderOf(const Kept& kept) {
  if (kept.vertex_order && kept.face_order) return "kept";
  if (kept.vertex_order) return "vertices only";
  return kept.face_order ? "faces only" : "changed";
}

std::string MarkdownRow(const Standing& s, const ScanSize& size) {
  if (!s.failure.empty()) {
    return fmt::format("| {} | {} | fails in {} | | | | | | | |\n", s.name, BitsOf(s.bits),
                       s.failure);
  }
  std::string row =
      fmt::format("| {} | {} | {:.2f} | {} | {} | {} / {} | {:.0f} / {:.0f} |", s.name,
                  BitsOf(s.bits), 8 * PerVertex(s.bytes, size), Ratio(s.encode), Ratio(s.decode),
                  Mebibytes(s.encode), Mebibytes(s.decode), PerVertex(s.encode.peak_bytes, size),
                  PerVertex(s.decode.peak_bytes, size));
  if (!s.kept) return row + " cannot be read | | |\n";
  return row + fmt::format(" {} | {} | {} |\n",
                           CameBack(s.kept->same_vertices, s.kept->vertices, s.kept->lost_vertices),
                           CameBack(s.kept->same_connectivity, s.kept->faces, s.kept->lost_faces),
                           OrderOf(*s.kept));
}

std::string ReferenceTimes(const Race& race) {
  for (const Standing& s : race.standings) {
    if (s.name == kReference && s.failure.empty()) {
      return fmt::format("{} with {} bits: {:.3f} s and {:.3f} s", s.name, s.bits, s.encode.seconds,
                         s.decode.seconds);
    }
  }
  return fmt::format("{} failed", kReference);
}

std::string CurveCell(const CurveSeries& series, size_t rate) {
  const auto& point = series.points[rate];
  return point ? fmt::format("{:.3g} ({:.2f})", point->error, point->bits_per_vertex) : "-";
}

std::string SimplifyCells(const CurveSeries& series, size_t rate) {
  const auto& point = series.points[rate];
  if (!point) return "- | - | -";
  return fmt::format("{} | {} | {}", CurveCell(series, rate), Grouped(point->faces),
                     point->position_bits);
}

std::string CsvPoint(const Curve& curve, const CurveSeries& series, size_t rate) {
  const auto& point = series.points[rate];
  if (!point) return "";
  return fmt::format("{},{},{},{},{},{},{},{}\n", curve.scan, curve.size.vertices, series.name,
                     curve.rates[rate], point->bits_per_vertex, point->error, point->faces,
                     point->position_bits > 0 ? point->position_bits : curve.bits);
}

}  // namespace

std::string MarkdownOf(const Race& race) {
  std::string text = fmt::format(
      "**{}**, {} vertices, {} faces; median of {} alternating runs. {}.\n\n"
      "| program | bits | bpv | encode | decode | peak, MiB | bytes per vertex | vertices | "
      "faces | order |\n|---|---|---|---|---|---|---|---|---|---|\n",
      race.scan, Grouped(race.size.vertices), Grouped(race.size.faces), race.runs,
      ReferenceTimes(race));
  for (const Standing& standing : race.standings) text += MarkdownRow(standing, race.size);
  return text;
}

std::string MarkdownOf(const Curve& curve) {
  std::string text = fmt::format("**{}**, {} vertices; {} samples.\n\n| bpv |", curve.scan,
                                 Grouped(curve.size.vertices), Grouped(curve.samples));
  std::string rule = "\n|---|";
  for (const CurveSeries& series : curve.folprom) {
    text += fmt::format(" {} |", series.name);
    rule += "---|";
  }
  text += " the paper | simplify + Draco | its faces | its bits |" + rule + "---|---|---|---|\n";
  for (size_t rate = 0; rate < curve.rates.size(); ++rate) {
    text += fmt::format("| {:g} |", curve.rates[rate]);
    for (const CurveSeries& series : curve.folprom) {
      text += fmt::format(" {} |", CurveCell(series, rate));
    }
    const double paper = curve.paper[rate];
    text += fmt::format(" {} | {} |\n", paper > 0 ? fmt::format("{:g}", paper) : "-",
                        SimplifyCells(curve.simplify, rate));
  }
  return text;
}

std::string CsvOf(const Race& race, bool header) {
  std::string text;
  if (header) {
    text =
        "scan,vertices,program,bits,bytes,bits_per_vertex,encode_seconds,decode_seconds,"
        "encode_ratio,decode_ratio,encode_peak_bytes,decode_peak_bytes,decoded_vertices,"
        "decoded_faces,lost_vertices,lost_faces,same_connectivity,vertex_order,face_order\n";
  }
  for (const Standing& s : race.standings) {
    if (!s.failure.empty() || !s.kept) continue;
    text += fmt::format(
        "{},{},\"{}\",{},{},{:.4f},{:.5f},{:.5f},{:.4f},{:.4f},{},{},{},{},{},{},{},{},{}\n",
        race.scan, race.size.vertices, s.name, BitsOf(s.bits), s.bytes,
        8 * PerVertex(s.bytes, race.size), s.encode.seconds, s.decode.seconds, s.encode.ratio,
        s.decode.ratio, s.encode.peak_bytes, s.decode.peak_bytes, s.kept->vertices, s.kept->faces,
        s.kept->lost_vertices, s.kept->lost_faces, s.kept->same_connectivity, s.kept->vertex_order,
        s.kept->face_order);
  }
  return text;
}

std::string CsvOf(const Curve& curve, bool header) {
  std::string text;
  if (header) text = "scan,vertices,program,requested,bits_per_vertex,mean_error_1e-4,faces,bits\n";
  for (size_t rate = 0; rate < curve.rates.size(); ++rate) {
    for (const CurveSeries& series : curve.folprom) text += CsvPoint(curve, series, rate);
    text += CsvPoint(curve, curve.simplify, rate);
  }
  return text;
}

}  // namespace folprom::peers
