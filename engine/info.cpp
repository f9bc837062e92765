#include <algorithm>
#include <cmath>

#include "engine/folp_file.h"
#include "engine/run_guarded.h"
#include "folprom/folprom.h"

namespace folprom {
namespace {

void DescribeLayers(const FolpFile& file, FileInfo* info) {
  const io::FileTable& table = file.table();
  for (size_t k = 0; k < table.layers.size(); ++k) {
    LayerInfo layer;
    layer.end_byte = file.container().LayerEnd(k);
    layer.bytes = layer.end_byte - file.container().LayerBegin(k);
    layer.vertices = table.layers[k].vertices;
    layer.faces = table.layers[k].faces;
    layer.error_bound = static_cast<double>(table.layers[k].error_bound);
    layer.bits_per_vertex = table.vertices == 0 ? 0
                                                : 8 * static_cast<double>(layer.end_byte) /
                                                      static_cast<double>(table.vertices);
    info->layers.push_back(layer);
  }
}

void DescribeBits(const FolpFile& file, FileInfo* info) {
  if (!file.container().has_all_tables()) return;
  const io::FileTable& table = file.table();
  info->has_bits = true;
  uint64_t kind_bits = 0, segment_bytes = 0;
  for (uint64_t bits : table.kind_bits) kind_bits += bits;
  for (uint64_t bits : table.attribute_bits) kind_bits += bits;
  for (uint64_t bytes : table.segment_bytes) segment_bytes += bytes;
  auto rate = [&](io::BitKind kind) {
    double bits = static_cast<double>(table.kind_bits[static_cast<size_t>(kind)]);
    return table.vertices == 0 ? 0 : bits / static_cast<double>(table.vertices);
  };
  info->split = rate(io::BitKind::kSplit);
  info->offsets = rate(io::BitKind::kOffsets);
  info->refinement = rate(io::BitKind::kRefinement);
  info->connectivity = rate(io::BitKind::kConnectivity);
  info->exceptions = rate(io::BitKind::kExceptions);
  info->seams = rate(io::BitKind::kSeams);
  info->table_bytes = file.container().table_bytes();
  info->checksum_bytes = file.container().checksum_bytes();
  // What the segments hold beyond the information in them: rounding up to whole bytes.
  info->flush_bytes = segment_bytes - std::min(segment_bytes, kind_bits / 8);
  info->overhead =
      static_cast<double>(info->table_bytes + info->checksum_bytes + info->flush_bytes) /
      static_cast<double>(std::max<uint64_t>(info->bytes, 1));
}

SectionInfo SectionOf(const io::FileTable& table, io::SectionKind kind) {
  const auto& section = table.Section(kind);
  return section ? SectionInfo{true, section->bytes} : SectionInfo{};
}

}  // namespace

Result<FileInfo> ReadInfo(const std::string& input, const Limits& limits) {
  return RunGuarded<FileInfo>([&] {
    FolpFile file(input, Extent::kPart);
    file.CheckLimits(limits);
    const io::FileTable& table = file.table();
    FileInfo info;
    info.format_version = io::kFormatVersion;
    info.vertices = table.vertices;
    info.faces = table.faces;
    info.bytes = file.container().file_bytes();
    info.bytes_present = file.bytes_present();
    info.layers_present = file.container().complete_layers();
    info.layers_total = file.container().layers_total();
    info.subtrees = table.subtrees.size();
    if (file.container().has_all_tables()) info.tolerance = table.tolerance;
    Lattice lattice = file.lattice();
    if (lattice.exact) {
      const ExactStep& step = lattice.exact->step;
      const auto longest = *std::max_element(table.extent.begin(), table.extent.end());
      info.exact = {step.is_float, step.radix, step.exponent, std::log2(longest + 1.0),
                    step.has_rests};
    }
    for (int axis = 0; axis < 3; ++axis) {
      size_t i = static_cast<size_t>(axis);
      info.box_lo[i] = lattice.ToModel(axis, 0);
      info.box_hi[i] = lattice.ToModel(axis, lattice.extent[i]);
    }
    info.codec = file.parameters().settings;
    for (size_t a = 0; a < table.schema.attributes.size(); ++a) {
      const io::VertexAttribute& attribute = table.schema.attributes[a];
      info.attributes.push_back({attribute.name, attribute.type,
                                 static_cast<double>(table.attribute_bits[a]),
                                 table.attribute_ranges[a].step});
    }
    info.remarks = table.remarks;
    info.is_soup = table.is_soup;
    info.order = SectionOf(table, io::SectionKind::kOrder);
    info.polygons = SectionOf(table, io::SectionKind::kPolygons);
    info.face_values = SectionOf(table, io::SectionKind::kFaceValues);
    for (const io::FaceAttribute& attribute : table.face_schema.attributes) {
      info.face_attributes.push_back({attribute.name, attribute.type, attribute.per_corner});
    }
    info.scan_faces = table.polygons;
    DescribeLayers(file, &info);
    DescribeBits(file, &info);
    return info;
  });
}

}  // namespace folprom
