#include "io/container/table_code.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cfloat>
#include <cmath>

#include "folprom/result.h"
#include "io/container/byte_code.h"
#include "io/container/row_code.h"
#include "io/container/size_code.h"

namespace folprom::io {
namespace {

constexpr uint64_t kMaxCoordinate = (uint64_t{1} << 30) - 1;
/// Fewest bytes of a record: varint, box of six, neighbour count.
constexpr uint64_t kLeastSubtreeBytes = 8;
/// Flags of the mesh: the origin is of floats; there are attributes or remarks; it is a soup; and,
/// from the third on, a bit for each section.
constexpr uint8_t kShortOrigin = 1, kExtras = 2, kSoup = 128, kFirstSection = 4;
constexpr uint8_t kAllFlags =
    kFirstSection * ((1 << kSectionKinds) - 1) | kExtras | kShortOrigin | kSoup;
/// Memory of a layer of a subtree: sizes and places of two segments, and the sizes again while
/// their array grows.
constexpr uint64_t kPairBytes = 48;
/// Bytes of a section that are never reached.
constexpr uint64_t kMostSectionBytes = uint64_t{1} << 56;

/// What so many layers take at least: a bit for each of three numbers, and the orders of the rows.
uint64_t LayerBits(uint64_t layers) { return 3 * (layers + kRowParameterBits); }

/// The lower half of an error bound is 0.
uint64_t UpperHalf(float error_bound) { return std::bit_cast<uint32_t>(error_bound) >> 16; }

LayerRecord Before(const FileTable& table, size_t layer) {
  return layer == 0 ? LayerRecord{} : table.layers[layer - 1];
}
/// Vertices by which the layer before grew.
uint64_t GrowthBefore(const FileTable& table, size_t layer) {
  return layer == 0 ? 0 : table.layers[layer - 1].vertices - Before(table, layer - 1).vertices;
}

void WriteLayers(const FileTable& table, size_t begin, size_t end, BitWriter* bits) {
  std::array<std::vector<uint64_t>, 3> rows;
  for (size_t i = begin; i < end; ++i) {
    const LayerRecord &layer = table.layers[i], before = Before(table, i);
    const uint64_t growth = layer.vertices - before.vertices;
    rows[0].push_back(ZigZag(UpperHalf(layer.error_bound) - UpperHalf(before.error_bound)));
    rows[1].push_back(ZigZag(growth - GrowthBefore(table, i)));
    // A closed surface has twice as many faces as vertices.
    rows[2].push_back(ZigZag(layer.faces - before.faces - 2 * growth));
  }
  for (const auto& row : rows) WriteRow(row, bits);
}

void ReadLayers(size_t count, const ByteReader& in, BitReader* bits, FileTable* table) {
  const size_t begin = table->layers.size();
  table->layers.resize(begin + count);
  int order = ReadOrder(bits);
  for (size_t i = begin; i < begin + count; ++i) {
    const uint64_t upper =
        UpperHalf(Before(*table, i).error_bound) + UnZigZag(ReadNumber(order, bits));
    if (upper > 0xffff) in.Fail("error bound of more bits than a float has");
    table->layers[i].error_bound = std::bit_cast<float>(static_cast<uint32_t>(upper) << 16);
  }
  order = ReadOrder(bits);
  for (size_t i = begin; i < begin + count; ++i) {
    const uint64_t left = table->vertices - Before(*table, i).vertices;
    const uint64_t growth = GrowthBefore(*table, i) + UnZigZag(ReadNumber(order, bits));
    if (growth > left) {
      in.Fail("growth of a layer's vertices is " + std::to_string(growth) + ", at most " +
              std::to_string(left));
    }
    table->layers[i].vertices = Before(*table, i).vertices + growth;
  }
  order = ReadOrder(bits);
  for (size_t i = begin; i < begin + count; ++i) {
    LayerRecord& layer = table->layers[i];
    const LayerRecord before = Before(*table, i);
    layer.faces =
        before.faces + 2 * (layer.vertices - before.vertices) + UnZigZag(ReadNumber(order, bits));
    if (layer.faces > kMaxCount) in.Fail("number of a layer's faces negative or beyond 2^48");
  }
}

void WriteSubtree(const SubtreeRecord& subtree, ByteWriter* out) {
  out->Varint(subtree.vertices);
  for (size_t axis = 0; axis < 3; ++axis) {
    out->Varint(static_cast<uint64_t>(subtree.box_lo[axis]));
    out->Varint(static_cast<uint64_t>(subtree.box_hi[axis] - subtree.box_lo[axis]));
  }
  out->Varint(subtree.lower_neighbours.size());
  uint64_t least = 0;
  for (const uint32_t neighbour : subtree.lower_neighbours) {
    out->Varint(neighbour - least);
    least = uint64_t{neighbour} + 1;
  }
}

SubtreeRecord ReadSubtree(size_t number, const FileTable& table, ByteReader* in) {
  SubtreeRecord subtree;
  subtree.vertices = static_cast<uint32_t>(in->VarintUpTo(UINT32_MAX, "number of vertices"));
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto extent = static_cast<uint64_t>(table.extent[axis]);
    const uint64_t lo = in->VarintUpTo(extent, "lower corner of a box");
    const uint64_t hi = lo + in->VarintUpTo(extent - lo, "side of a box");
    subtree.box_lo[axis] = static_cast<int32_t>(lo);
    subtree.box_hi[axis] = static_cast<int32_t>(hi);
  }
  const uint64_t count = in->VarintUpTo(number, "number of lower neighbours");
  if (count > in->left()) in->Fail("more neighbours than bytes left");
  subtree.lower_neighbours.resize(count);
  uint64_t least = 0;
  for (uint32_t& neighbour : subtree.lower_neighbours) {
    if (least >= number) in->Fail("lower neighbour not below its subtree");
    least += in->VarintUpTo(number - 1 - least, "step to the next lower neighbour");
    neighbour = static_cast<uint32_t>(least++);
  }
  return subtree;
}

/// Are floats enough for the origin.
bool HasShortOrigin(const FileTable& table) {
  const auto same = [](double value) {
    if (std::fabs(value) > static_cast<double>(FLT_MAX)) return false;
    const double near = static_cast<double>(static_cast<float>(value));
    return std::bit_cast<uint64_t>(near) == std::bit_cast<uint64_t>(value);
  };
  return std::all_of(table.origin.begin(), table.origin.end(), same);
}

SizeGrid GridOf(const FileTable& table, size_t layers) {
  return {layers, table.subtrees.size(), table.HasSeams()};
}

/// Segments that the layers of the first table hold at least, so that each table pays.
constexpr uint64_t kFirstBytes = 256;

/// One after the last layer of each table: a table tells of the layers that double the bytes.
std::vector<size_t> EndsOfTables(const FileTable& table) {
  std::vector<size_t> ends;
  const size_t layer_segments = table.subtrees.size() * 2;
  uint64_t before = kFirstBytes, inside = 0;
  for (size_t layer = 0; layer < table.layers.size(); ++layer) {
    for (size_t i = 0; i < layer_segments; ++i) {
      inside += table.segment_bytes[layer * layer_segments + i];
    }
    if (inside < before || layer + 1 == table.layers.size()) continue;
    ends.push_back(layer + 1);
    before += inside;
    inside = 0;
  }
  ends.push_back(table.layers.size());
  return ends;
}

void WriteText(std::string_view text, ByteWriter* out) {
  out->Varint(text.size());
  out->Bytes({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
}

std::string ReadText(size_t longest, std::string_view what, ByteReader* in) {
  const auto bytes = in->Bytes(in->VarintUpTo(longest, what));
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Beside the type of an attribute: it is rounded to steps.
constexpr uint8_t kRounded = 16;

void WriteRange(const AttributeRange& range, ByteWriter* out) {
  out->Varint(range.least);
  out->Varint(range.most - range.least);
}

AttributeRange ReadRange(uint64_t largest, ByteReader* in) {
  AttributeRange range;
  range.least = in->VarintUpTo(largest, "least value of an attribute");
  range.most = range.least + in->VarintUpTo(largest - range.least, "range of an attribute");
  return range;
}

ScalarType TypeOf(uint8_t type, const ByteReader* in) {
  if (type >= kScalarTypes) in->Fail("type of an attribute does not exist");
  return static_cast<ScalarType>(type);
}

void WriteFaceSchema(const FileTable& table, ByteWriter* out) {
  const std::vector<FaceAttribute>& attributes = table.face_schema.attributes;
  out->Varint(attributes.size());
  size_t column = 0;
  for (const FaceAttribute& attribute : attributes) {
    WriteText(attribute.name, out);
    out->U8(static_cast<uint8_t>(attribute.type));
    out->Varint(attribute.per_corner);
    for (size_t i = 0; i < attribute.columns(); ++i) WriteRange(table.face_ranges[column++], out);
  }
  out->Varint(table.face_schema.before_indices);
}

void ReadFaceSchema(ByteReader* in, FileTable* table) {
  const uint64_t count = in->VarintUpTo(kMostAttributes, "number of attributes of faces");
  for (uint64_t i = 0; i < count; ++i) {
    FaceAttribute attribute;
    attribute.name = ReadText(kLongestAttributeName, "length of an attribute's name", in);
    attribute.type = TypeOf(in->U8(), in);
    attribute.per_corner =
        static_cast<uint32_t>(in->VarintUpTo(kMostPerCorner, "numbers of a corner"));
    for (size_t c = 0; c < attribute.columns(); ++c) {
      table->face_ranges.push_back(ReadRange(LargestOrdered(attribute.type), in));
    }
    table->face_schema.attributes.push_back(std::move(attribute));
  }
  table->face_schema.before_indices = in->VarintUpTo(count, "attributes before the corners");
}

void WriteExtras(const FileTable& table, ByteWriter* out) {
  const std::vector<VertexAttribute>& attributes = table.schema.attributes;
  out->Varint(attributes.size());
  for (size_t i = 0; i < attributes.size(); ++i) {
    WriteText(attributes[i].name, out);
    const AttributeRange& range = table.attribute_ranges[i];
    const auto type = static_cast<uint8_t>(attributes[i].type);
    out->U8(range.step > 0 ? type | kRounded : type);
    if (range.step > 0) {
      out->F64(range.first);
      out->F64(range.step);
    }
    WriteRange(range, out);
  }
  out->Varint(table.schema.before_position);
  out->Varint(table.remarks.size());
  for (const std::string& remark : table.remarks) WriteText(remark, out);
  if (!table.face_schema.empty()) WriteFaceSchema(table, out);
}

void ReadExtras(ByteReader* in, FileTable* table) {
  const uint64_t count = in->VarintUpTo(kMostAttributes, "number of attributes");
  for (uint64_t i = 0; i < count; ++i) {
    VertexAttribute& attribute = table->schema.attributes.emplace_back();
    attribute.name = ReadText(kLongestAttributeName, "length of an attribute's name", in);
    const uint8_t type = in->U8();
    const bool is_rounded = (type & kRounded) != 0;
    attribute.type = TypeOf(type & static_cast<uint8_t>(~kRounded), in);
    const double first = is_rounded ? in->F64() : 0, step = is_rounded ? in->F64() : 0;
    if (is_rounded && !(step > 0)) in->Fail("steps of an attribute not above 0");
    AttributeRange range = ReadRange(is_rounded ? kMostSteps : LargestOrdered(attribute.type), in);
    range.first = first;
    range.step = step;
    table->attribute_ranges.push_back(range);
  }
  table->attribute_bits.resize(count, 0);
  table->schema.before_position = in->VarintUpTo(count, "attributes before the position");
  const uint64_t remarks = in->VarintUpTo(in->left(), "number of remarks");
  if (remarks > kMostRemarkBytes) in->Fail("more remarks than 16 MiB can hold");
  for (uint64_t i = 0; i < remarks; ++i) {
    table->remarks.push_back(ReadText(kMostRemarkBytes, "length of a remark", in));
  }
  if (table->Section(SectionKind::kFaceValues)) ReadFaceSchema(in, table);
  if (!table->HasExtras()) in->Fail("neither attributes nor remarks where they are announced");
}

uint8_t SectionFlags(const FileTable& table) {
  uint8_t flags = 0;
  for (size_t i = 0; i < kSectionKinds; ++i) {
    if (table.sections[i]) flags = static_cast<uint8_t>(flags | kFirstSection << i);
  }
  return flags;
}

void WriteSections(const FileTable& table, ByteWriter* out) {
  if (!table.HasSections()) return;
  out->Varint(table.polygons);
  out->Varint(table.largest_face);
  for (const std::optional<SectionRecord>& section : table.sections) {
    if (!section) continue;
    out->Varint(section->bytes);
    out->U64(section->digest);
  }
}

void ReadSections(ByteReader* in, FileTable* table) {
  if (!table->HasSections()) return;
  table->polygons = in->VarintUpTo(table->faces, "number of faces as the scan has them");
  table->largest_face = in->VarintUpTo(table->faces + 2, "corners of the largest face");
  for (std::optional<SectionRecord>& section : table->sections) {
    if (!section) continue;
    section->bytes = in->VarintUpTo(kMostSectionBytes, "length of a section");
    section->digest = in->U64();
  }
}

void WriteMesh(const FileTable& table, ByteWriter* out) {
  out->Varint(table.vertices);
  out->Varint(table.faces);
  out->U8(table.coordinate_type);
  const bool is_short = HasShortOrigin(table);
  out->U8(static_cast<uint8_t>((is_short ? kShortOrigin : 0) | (table.HasExtras() ? kExtras : 0) |
                               SectionFlags(table) | (table.is_soup ? kSoup : 0)));
  for (const double origin : table.origin) {
    if (is_short) {
      out->F32(static_cast<float>(origin));
    } else {
      out->F64(origin);
    }
  }
  out->F64(table.unit);
  for (const int32_t extent : table.extent) out->Varint(static_cast<uint64_t>(extent));
  out->Varint(table.codec.size());
  out->Bytes(table.codec);
  if (table.HasExtras()) WriteExtras(table, out);
  out->Varint(table.layers.size());
  out->Varint(table.subtrees.size());
  for (const SubtreeRecord& subtree : table.subtrees) WriteSubtree(subtree, out);
}

}  // namespace

std::vector<CodedTable> EncodeTables(const FileTable& table) {
  const std::string fault = TableFault(table);
  if (!fault.empty()) throw Failure(ErrorKind::kInternal, "table to write: " + fault);
  const std::vector<size_t> ends = EndsOfTables(table);
  std::vector<CodedTable> tables(ends.size());
  // Each tells how long the next one is.
  for (size_t i = ends.size(); i-- > 0;) {
    const size_t begin = i == 0 ? 0 : ends[i - 1], count = ends[i] - begin;
    ByteWriter out;
    if (i == 0) WriteMesh(table, &out);
    out.Varint(count);
    BitWriter bits(&out);
    WriteLayers(table, begin, ends[i], &bits);
    const auto sizes = std::span(table.segment_bytes).first(ends[i] * table.subtrees.size() * 2);
    WriteSizes(sizes, GridOf(table, count), &bits);
    bits.Finish();
    if (i + 1 < ends.size()) {
      out.Varint(tables[i + 1].bytes.size());
    } else {
      out.F64(table.tolerance);
      out.U64(table.digest.vertices);
      out.U64(table.digest.faces);
      for (const uint64_t kind : table.kind_bits) out.Varint(kind);
      for (const uint64_t bits_of_one : table.attribute_bits) out.Varint(bits_of_one);
      WriteSections(table, &out);
    }
    tables[i] = {ends[i], std::move(out).Take()};
  }
  return tables;
}

void TableDecoder::Decode(std::span<const uint8_t> bytes, uint64_t offset) {
  ByteReader in(bytes, file_, offset);
  if (!has_mesh_) DecodeMesh(&in);
  has_mesh_ = true;
  DecodeLayers(&in);
  if (table_.layers.size() < layers_total_) {
    next_bytes_ = in.Varint();
    if (next_bytes_ == 0) in.Fail("layers are left, but no table of them");
  } else {
    next_bytes_ = 0;
    table_.tolerance = in.F64();
    table_.digest.vertices = in.U64();
    table_.digest.faces = in.U64();
    for (uint64_t& bits : table_.kind_bits) bits = in.Varint();
    for (uint64_t& bits : table_.attribute_bits) bits = in.Varint();
    ReadSections(&in, &table_);
  }
  if (in.left() > 0) in.Fail(std::to_string(in.left()) + " bytes after the end of the table");
  const std::string fault = TableFault(table_);
  if (!fault.empty()) throw Failure(ErrorKind::kCorrupt, std::string(file_) + ": table: " + fault);
}

void TableDecoder::DecodeMesh(ByteReader* in) {
  table_.vertices = in->VarintUpTo(kMaxCount, "number of vertices");
  table_.faces = in->VarintUpTo(kMaxCount, "number of faces");
  table_.coordinate_type = in->U8();
  const uint8_t flags = in->U8();
  if ((flags & ~kAllFlags) != 0) in->Fail("flags of the mesh that are not known");
  for (size_t i = 0; i < kSectionKinds; ++i) {
    if ((flags & kFirstSection << i) != 0) table_.sections[i].emplace();
  }
  table_.is_soup = (flags & kSoup) != 0;
  const bool is_short = (flags & kShortOrigin) != 0;
  for (double& origin : table_.origin) {
    origin = is_short ? static_cast<double>(in->F32()) : in->F64();
  }
  if (!is_short && HasShortOrigin(table_)) {
    in->Fail("origin of the lattice longer than it need be");
  }
  table_.unit = in->F64();
  for (int32_t& extent : table_.extent) {
    extent = static_cast<int32_t>(in->VarintUpTo(kMaxCoordinate, "extent of the lattice"));
  }
  const auto codec = in->Bytes(in->VarintUpTo(in->left(), "length of the coder's settings"));
  table_.codec.assign(codec.begin(), codec.end());
  if ((flags & kExtras) != 0) ReadExtras(in, &table_);
  layers_total_ = in->VarintUpTo(kMaxLayers, "number of layers");
  const uint64_t subtrees = in->VarintUpTo(UINT32_MAX, "number of subtrees");
  if (subtrees * kLeastSubtreeBytes > in->left()) {
    in->Fail(std::to_string(subtrees) + " subtrees need at least " +
             std::to_string(subtrees * kLeastSubtreeBytes) + " bytes of table, " +
             std::to_string(in->left()) + " are left");
  }
  table_.subtrees.resize(subtrees);
  for (size_t i = 0; i < subtrees; ++i) table_.subtrees[i] = ReadSubtree(i, table_, in);
}

void TableDecoder::DecodeLayers(ByteReader* in) {
  const size_t left = layers_total_ - table_.layers.size();
  const uint64_t count = in->VarintUpTo(left, "number of layers of a table");
  if (count == 0 && left > 0) in->Fail("a table of no layer");
  const SizeGrid grid = GridOf(table_, count);
  if (LayerBits(count) + grid.LeastBits() > uint64_t{8} * in->left()) {
    in->Fail("fewer bytes left than the layers and segment sizes need");
  }
  // Fewer than 2^12 layers and 2^32 subtrees.
  const uint64_t pairs = (table_.layers.size() + count) * table_.subtrees.size();
  if (pairs > most_bytes_ / kPairBytes) {
    throw Failure(ErrorKind::kLimit, std::string(file_) + ": table: the sizes of " +
                                         std::to_string(2 * pairs) + " segments would take " +
                                         std::to_string(kPairBytes * pairs >> 20) +
                                         " MiB, more than a file of this length may");
  }
  BitReader bits(in);
  ReadLayers(count, *in, &bits, &table_);
  ReadSizes(grid, *in, &bits, &table_.segment_bytes);
  bits.Finish();
}

}  // namespace folprom::io
