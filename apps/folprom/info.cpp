#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <iterator>
#include <memory>
#include <type_traits>
#include <variant>

#include "apps/folprom/limit_flags.h"
#include "apps/folprom/options.h"
#include "apps/folprom/report.h"
#include "apps/folprom/session.h"
#include "apps/folprom/verbs.h"
#include "folprom/folprom.h"
#include "folprom/settings_keys.h"

namespace folprom::cli {
namespace {

constexpr const char* kDescription =
    "Show what a file holds and its levels of detail\n"
    "\n"
    "  folprom info scan.folp\n"
    "  folprom info scan.folp --json";

struct InfoFlags {
  CommonFlags common;
  LimitFlags limits;
  std::string input;
};

double BitsPerVertex(const FileInfo& info) {
  return info.vertices == 0
             ? 0
             : 8 * static_cast<double>(info.bytes) / static_cast<double>(info.vertices);
}

/// That the whole mesh has when it is decoded.
uint64_t ScanVertices(const FileInfo& info) {
  return info.is_soup ? 3 * info.faces : info.vertices;
}

struct Kind {
  const char* name;
  double FileInfo::*bits_per_vertex;
};
constexpr Kind kKinds[] = {
    {"split", &FileInfo::split},           {"offsets", &FileInfo::offsets},
    {"refinement", &FileInfo::refinement}, {"connectivity", &FileInfo::connectivity},
    {"exceptions", &FileInfo::exceptions}, {"seams", &FileInfo::seams}};

Json CodecJson(const CodecSettings& settings) {
  Json codec = Json::object();
  for (const SettingKey& key : SettingKeys()) {
    std::visit(
        [&](auto member) {
          const auto value = settings.*member;
          if constexpr (std::is_enum_v<std::remove_cv_t<decltype(value)>>) {
            codec[std::string(key.name)] = key.choices[static_cast<size_t>(value)];
          } else {
            codec[std::string(key.name)] = value;
          }
        },
        key.member);
  }
  return codec;
}

/// Null where the file is not exact.
Json ExactJson(const FileInfo& info) {
  if (!info.exact) return nullptr;
  return {{"type", info.exact->is_float ? "float32" : "float64"},
          {"radix", info.exact->radix},
          {"exponent", info.exact->exponent},
          {"bits", info.exact->bits},
          {"has_rests", info.exact->has_rests}};
}

/// Null where the file does not keep it.
Json SectionJson(const SectionInfo& section) {
  if (!section.is_kept) return nullptr;
  return {{"bytes", section.bytes}};
}

Json InfoJson(const FileInfo& info) {
  Json layers = Json::array();
  for (const LayerInfo& layer : info.layers) {
    layers.push_back({{"bytes", layer.bytes},
                      {"end_byte", layer.end_byte},
                      {"vertices", layer.vertices},
                      {"faces", layer.faces},
                      {"error_bound", layer.error_bound},
                      {"bits_per_vertex", layer.bits_per_vertex}});
  }
  Json kinds = Json::object();
  for (const Kind& kind : kKinds) {
    kinds[kind.name] = info.has_bits ? Json(info.*kind.bits_per_vertex) : Json();
  }
  return {{"format_version", info.format_version},
          {"vertices", info.vertices},
          {"faces", info.faces},
          {"is_soup", info.is_soup},
          {"scan_vertices", ScanVertices(info)},
          {"bytes", info.bytes},
          {"bytes_present", info.bytes_present},
          {"bits_per_vertex", BitsPerVertex(info)},
          {"subtrees", info.subtrees},
          {"tolerance", OrNull(info.tolerance)},
          {"exact", ExactJson(info)},
          {"box_lo", info.box_lo},
          {"box_hi", info.box_hi},
          {"bits_per_vertex_by_kind", kinds},
          {"attributes", AttributesJson(info.attributes, info.has_bits ? info.vertices : 0)},
          {"comments", info.remarks},
          {"order", SectionJson(info.order)},
          {"polygons", SectionJson(info.polygons)},
          {"face_values", SectionJson(info.face_values)},
          {"face_attributes", FaceAttributesJson(info.face_attributes)},
          {"scan_faces", info.scan_faces > 0 ? Json(info.scan_faces) : Json()},
          {"table_bytes", info.table_bytes},
          {"checksum_bytes", info.checksum_bytes},
          {"flush_bytes", info.flush_bytes},
          {"overhead", info.overhead},
          {"codec", CodecJson(info.codec)},
          {"layers_present", info.layers_present},
          {"layers_total", info.layers_total},
          {"layers", layers}};
}

std::string InfoText(const std::string& path, const FileInfo& info) {
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "{}: format {}, {} vertices, {} faces\n", path, info.format_version,
                 Grouped(info.vertices), Grouped(info.faces));
  fmt::format_to(out, "{} bytes, {:.2f} bits per vertex, {} subtrees, tolerance {}, effort {}\n",
                 Grouped(info.bytes), BitsPerVertex(info), Grouped(info.subtrees),
                 info.tolerance ? fmt::format("{:.6g}", *info.tolerance) : "unknown",
                 info.codec.effort);
  if (info.is_soup) {
    fmt::format_to(out, "a soup: {} vertices, three a face, at these {} places\n",
                   Grouped(ScanVertices(info)), Grouped(info.vertices));
  }
  if (info.exact) {
    fmt::format_to(out, "exact: every bit of a {}, on a lattice of {}^{} of {:.2f} bits{}\n",
                   info.exact->is_float ? "float32" : "float64", info.exact->radix,
                   -info.exact->exponent, info.exact->bits,
                   info.exact->has_rests ? " and rests" : "");
  }
  if (info.layers_present < info.layers_total) {
    fmt::format_to(out, "cut: {} bytes and {} of {} layers are here\n", Grouped(info.bytes_present),
                   info.layers_present, info.layers_total);
  }
  fmt::format_to(out, "box {:.6g} {:.6g} {:.6g} .. {:.6g} {:.6g} {:.6g}\n", info.box_lo[0],
                 info.box_lo[1], info.box_lo[2], info.box_hi[0], info.box_hi[1], info.box_hi[2]);
  for (const AttributeInfo& attribute : info.attributes) {
    fmt::format_to(out, "{} {}", NameOf(attribute.type), attribute.name);
    if (attribute.step > 0) fmt::format_to(out, " in steps of {:.6g}", attribute.step);
    if (info.has_bits && info.vertices > 0) {
      fmt::format_to(out, ": {:.3f} bits per vertex",
                     attribute.bits / static_cast<double>(info.vertices));
    }
    fmt::format_to(out, "\n");
  }
  for (const std::string& remark : info.remarks) {
    fmt::format_to(out, "{}\n", Printable(remark));
  }
  if (info.order.is_kept) {
    fmt::format_to(out, "keeps the order of vertices and faces: {} bytes\n",
                   Grouped(info.order.bytes));
  }
  if (info.polygons.is_kept) {
    fmt::format_to(out, "keeps polygons, {} faces in the scan: {} bytes\n",
                   Grouped(info.scan_faces), Grouped(info.polygons.bytes));
  }
  for (const FaceAttributeInfo& attribute : info.face_attributes) {
    fmt::format_to(out, "{} {} of each {}", NameOf(attribute.type), attribute.name,
                   attribute.per_corner == 0 ? "face" : "corner");
    if (attribute.per_corner > 1) fmt::format_to(out, ", {} of them", attribute.per_corner);
    fmt::format_to(out, "\n");
  }
  if (info.face_values.is_kept) {
    fmt::format_to(out, "keeps attributes of faces: {} bytes\n", Grouped(info.face_values.bytes));
  }
  if (info.has_bits) {
    fmt::format_to(out, "bits per vertex:");
    for (const Kind& kind : kKinds) {
      fmt::format_to(out, " {} {:.3f}", kind.name, info.*kind.bits_per_vertex);
    }
    fmt::format_to(out, "; tables, checksums, flushes {:.2f} % of the file\n", 100 * info.overhead);
  }
  fmt::format_to(out, "\n");
  fmt::format_to(out, "{:>5} {:>15} {:>15} {:>14} {:>14} {:>13} {:>8}\n", "layer", "bytes",
                 "end byte", "vertices", "faces", "error bound", "bits/v");
  size_t number = 0;
  for (const LayerInfo& layer : info.layers) {
    fmt::format_to(out, "{:>5} {:>15} {:>15} {:>14} {:>14} {:>13.6g} {:>8.3f}\n", ++number,
                   Grouped(layer.bytes), Grouped(layer.end_byte), Grouped(layer.vertices),
                   Grouped(layer.faces), layer.error_bound, layer.bits_per_vertex);
  }
  return text;
}

int Run(const InfoFlags& flags) {
  Session session(flags.common);
  Limits limits;
  flags.limits.ApplyTo(&limits);
  const FileInfo info = ReadInfo(flags.input, limits).value();
  session.StopDisplay();
  if (flags.common.json) {
    PrintJson(InfoJson(info));
  } else if (!flags.common.quiet) {
    Print(InfoText(flags.input, info));
  }
  return 0;
}

}  // namespace

Verb AddInfo(CLI::App& program) {
  auto flags = std::make_shared<InfoFlags>();
  CLI::App* verb = program.add_subcommand("info", kDescription);
  verb->add_option("F.folp", flags->input, "File to read")->type_name("")->required();
  AddLimitFlag(verb, &flags->limits);
  AddCommonFlags(verb, &flags->common);
  return {verb, [flags] { return Run(*flags); }};
}

}  // namespace folprom::cli
