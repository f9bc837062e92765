// The rules between the fields of a table, the same for what is written and what is read.
#include <bit>
#include <cmath>

#include "io/container/table_code.h"

namespace folprom::io {
namespace {

constexpr int32_t kMaxCoordinate = (1 << 30) - 1;
constexpr uint8_t kFloat32 = 6, kFloat64 = 7;  // as ScalarType numbers them
constexpr uint64_t kMaxSum = uint64_t{1} << 62;

std::string LatticeFault(const FileTable& table) {
  if (table.coordinate_type != kFloat32 && table.coordinate_type != kFloat64) {
    return "coordinate type " + std::to_string(table.coordinate_type) + ", must be 6 or 7";
  }
  for (const double origin : table.origin) {
    if (!std::isfinite(origin)) return "origin of the lattice not finite";
  }
  if (!std::isfinite(table.unit) || table.unit <= 0) return "unit of the lattice not above 0";
  for (const int32_t extent : table.extent) {
    if (extent < 0 || extent > kMaxCoordinate) return "extent of the lattice not below 2^30";
  }
  if (!std::isfinite(table.tolerance) || table.tolerance < 0) return "tolerance not 0 or above";
  return {};
}

std::string AttributeFault(const FileTable& table, size_t number) {
  const std::vector<VertexAttribute>& attributes = table.schema.attributes;
  const VertexAttribute& attribute = attributes[number];
  if (!IsAttributeName(attribute.name)) return "a name that no attribute can have";
  for (size_t other = 0; other < number; ++other) {
    if (attributes[other].name == attribute.name) return "the name of another attribute";
  }
  if (static_cast<size_t>(attribute.type) >= kScalarTypes) return "a type that does not exist";
  const AttributeRange& range = table.attribute_ranges[number];
  const uint64_t largest = range.step > 0 ? kMostSteps : LargestOrdered(attribute.type);
  if (range.least > range.most || range.most > largest) {
    return "range of values turned inside out, or beyond its type";
  }
  const double last = range.first + range.step * static_cast<double>(range.most);
  const bool is_plain = range.step == 0 && range.first == 0;
  if (!is_plain && (!IsFloat(attribute.type) || !(range.step > 0) || !std::isfinite(range.first) ||
                    !std::isfinite(last))) {
    return "rounded to steps that cannot be";
  }
  return {};
}

std::string ExtrasFault(const FileTable& table) {
  const size_t count = table.schema.attributes.size();
  if (count > kMostAttributes) return "more than 255 attributes";
  if (table.attribute_ranges.size() != count || table.attribute_bits.size() != count) {
    return "attributes without ranges or bits";
  }
  if (table.schema.before_position > count) return "the position stands behind its attributes";
  for (size_t i = 0; i < count; ++i) {
    const std::string fault = AttributeFault(table, i);
    if (!fault.empty()) return "attribute " + std::to_string(i) + ": " + fault;
  }
  size_t bytes = 0;
  for (const std::string& remark : table.remarks) {
    if (!IsRemark(remark)) return "a remark that is no line of a header";
    bytes += remark.size();
  }
  return bytes > kMostRemarkBytes ? "more than 16 MiB of remarks" : "";
}

std::string FaceAttributeFault(const FileTable& table, size_t number, size_t column) {
  const std::vector<FaceAttribute>& attributes = table.face_schema.attributes;
  const FaceAttribute& attribute = attributes[number];
  if (!IsFaceAttributeName(attribute.name)) return "a name that no attribute can have";
  for (size_t other = 0; other < number; ++other) {
    if (attributes[other].name == attribute.name) return "the name of another attribute";
  }
  for (size_t i = column; i < column + attribute.columns(); ++i) {
    const AttributeRange& range = table.face_ranges[i];
    if (range.least > range.most || range.most > LargestOrdered(attribute.type)) {
      return "range of values turned inside out, or beyond its type";
    }
  }
  return {};
}

std::string FaceSchemaFault(const FileTable& table) {
  const FaceSchema& schema = table.face_schema;
  if (table.Section(SectionKind::kFaceValues).has_value() == schema.empty()) {
    return "attributes of faces without their section, or a section without any";
  }
  FaceSchema so_far;
  for (size_t i = 0; i < schema.attributes.size(); ++i) {
    const FaceAttribute& attribute = schema.attributes[i];
    if (static_cast<size_t>(attribute.type) >= kScalarTypes ||
        attribute.per_corner > kMostPerCorner || !so_far.HasRoomFor(attribute)) {
      return "attributes of faces of no type, or too many";
    }
    so_far.attributes.push_back(attribute);
  }
  if (table.face_ranges.size() != schema.Columns()) return "attributes of faces without ranges";
  if (schema.before_indices > schema.attributes.size()) {
    return "the corners stand behind the attributes of their faces";
  }
  size_t column = 0;
  for (size_t i = 0; i < schema.attributes.size(); ++i) {
    const std::string fault = FaceAttributeFault(table, i, column);
    if (!fault.empty()) return "attribute of faces " + std::to_string(i) + ": " + fault;
    column += schema.attributes[i].columns();
  }
  return {};
}

std::string LayersFault(const FileTable& table) {
  if (table.layers.size() > kMaxLayers) return "more than 4096 layers";
  uint64_t before = 0;
  for (size_t i = 0; i < table.layers.size(); ++i) {
    const LayerRecord& layer = table.layers[i];
    const std::string place = "layer " + std::to_string(i) + ": ";
    if (!std::isfinite(layer.error_bound) || layer.error_bound < 0) {
      return place + "error bound not 0 or above";
    }
    if ((std::bit_cast<uint32_t>(layer.error_bound) & 0xffff) != 0) {
      return place + "error bound of more bits than the table has";
    }
    if (layer.vertices < before) return place + "fewer vertices than in the layer before";
    if (layer.vertices > table.vertices) return place + "more vertices than the mesh has";
    if (layer.faces > kMaxCount) return place + "number of faces beyond 2^48";
    before = layer.vertices;
  }
  return {};
}

std::string SubtreeFault(const SubtreeRecord& subtree, size_t number, const FileTable& table) {
  if (subtree.vertices == 0) return "no vertices";
  for (size_t axis = 0; axis < 3; ++axis) {
    if (subtree.box_lo[axis] < 0 || subtree.box_hi[axis] > table.extent[axis]) {
      return "box outside the extent";
    }
    if (subtree.box_lo[axis] > subtree.box_hi[axis]) return "box turned inside out";
  }
  uint64_t least = 0;
  for (const uint32_t neighbour : subtree.lower_neighbours) {
    if (neighbour >= number) return "lower neighbour not below its subtree";
    if (neighbour < least) return "lower neighbours not ascending";
    least = uint64_t{neighbour} + 1;
  }
  return {};
}

std::string SubtreesFault(const FileTable& table) {
  if (table.subtrees.size() > UINT32_MAX) return "2^32 subtrees or more";
  uint64_t vertices = 0;
  for (size_t i = 0; i < table.subtrees.size(); ++i) {
    const std::string fault = SubtreeFault(table.subtrees[i], i, table);
    if (!fault.empty()) return "subtree " + std::to_string(i) + ": " + fault;
    vertices += table.subtrees[i].vertices;
  }
  if (vertices != table.vertices) {
    return "the subtrees have " + std::to_string(vertices) + " vertices, the mesh " +
           std::to_string(table.vertices);
  }
  return {};
}

std::string SegmentsFault(const FileTable& table) {
  if (table.segment_bytes.size() != table.layers.size() * table.subtrees.size() * 2) {
    return "number of segment sizes is not layers x subtrees x 2";
  }
  if (!table.HasSeams()) {
    for (size_t i = 1; i < table.segment_bytes.size(); i += 2) {
      if (table.segment_bytes[i] > 0) return "a seam segment, but no subtree has a lower neighbour";
    }
  }
  uint64_t sum = 0;
  for (const uint64_t bytes : table.segment_bytes) {
    if (bytes > kMaxSegmentBytes) return "a segment of 2^32 bytes or more";
    sum += bytes;
    if (sum > kMaxSum) return "sizes of the segments overflow";
  }
  return {};
}

std::string SectionsFault(const FileTable& table) {
  const bool has_polygons = table.Section(SectionKind::kPolygons).has_value();
  if (!table.HasSections() && (table.polygons != 0 || table.largest_face != 0)) {
    return "faces of the scan, but no section";
  }
  if (table.polygons > table.faces || table.largest_face > table.faces + 2) {
    return "more faces in the scan than triangles";
  }
  // Only the last table tells.
  if (table.largest_face != 0 && !has_polygons && table.largest_face != 3) {
    return "a face of more than three corners, but no polygons";
  }
  return {};
}

std::string SoupFault(const FileTable& table) {
  if (!table.is_soup) return {};
  if (table.vertices > 3 * table.faces) return "more vertices than a soup of its faces has";
  if (!table.schema.attributes.empty()) return "attributes of the vertices of a soup";
  if (table.Section(SectionKind::kPolygons)) return "polygons in a soup";
  if (table.Section(SectionKind::kFaceValues)) return "attributes of the faces of a soup";
  return {};
}

}  // namespace

float NextErrorBound(double bound) {
  const float above = std::nextafter(static_cast<float>(bound), INFINITY);
  return std::bit_cast<float>((std::bit_cast<uint32_t>(above) + 0xffff) & 0xffff0000);
}

std::string TableFault(const FileTable& table) {
  if (table.vertices > kMaxCount || table.faces > kMaxCount) {
    return "2^48 vertices or faces, or more";
  }
  for (const auto& fault :
       {LatticeFault(table), ExtrasFault(table), FaceSchemaFault(table), LayersFault(table),
        SubtreesFault(table), SegmentsFault(table), SectionsFault(table), SoupFault(table)}) {
    if (!fault.empty()) return fault;
  }
  return {};
}

}  // namespace folprom::io
