#include "io/container/table_code.h"

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>

#include "folprom/result.h"
#include "io/container/byte_code.h"
#include "io/container/size_code.h"

namespace folprom::io {
namespace {

constexpr uint64_t kMaxCoordinate = (uint64_t{1} << 30) - 1;
// Fewest bytes of a record: three varints; varint, box of six, neighbour count.
constexpr uint64_t kLeastLayerBytes = 3;
constexpr uint64_t kLeastSubtreeBytes = 8;

/// The lower half of an error bound is 0.
uint64_t UpperHalf(float error_bound) { return std::bit_cast<uint32_t>(error_bound) >> 16; }

void WriteLayers(const FileTable& table, ByteWriter* out) {
  LayerRecord before;
  for (const LayerRecord& layer : table.layers) {
    out->Varint(ZigZag(UpperHalf(layer.error_bound) - UpperHalf(before.error_bound)));
    const uint64_t more_vertices = layer.vertices - before.vertices;
    out->Varint(more_vertices);
    // A closed surface has twice as many faces as vertices.
    out->Varint(ZigZag(layer.faces - before.faces - 2 * more_vertices));
    before = layer;
  }
}

void ReadLayers(ByteReader* in, FileTable* table) {
  LayerRecord before;
  for (LayerRecord& layer : table->layers) {
    const uint64_t upper = UpperHalf(before.error_bound) + UnZigZag(in->Varint());
    if (upper > 0xffff) in->Fail("error bound of more bits than a float has");
    layer.error_bound = std::bit_cast<float>(static_cast<uint32_t>(upper) << 16);
    const uint64_t more_vertices =
        in->VarintUpTo(table->vertices - before.vertices, "growth of a layer's vertices");
    layer.vertices = before.vertices + more_vertices;
    layer.faces = before.faces + 2 * more_vertices + UnZigZag(in->Varint());
    if (layer.faces > kMaxCount) in->Fail("number of a layer's faces negative or beyond 2^48");
    before = layer;
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

SizeGrid GridOf(const FileTable& table) {
  return {table.layers.size(), table.subtrees.size(), table.HasSeams()};
}

/// Layers, subtrees and sizes, none of which may claim more than the bytes left can hold.
void ReadCounts(ByteReader* in, FileTable* table) {
  const uint64_t layers = in->VarintUpTo(kMaxLayers, "number of layers");
  const uint64_t subtrees = in->VarintUpTo(UINT32_MAX, "number of subtrees");
  const uint64_t records = layers * kLeastLayerBytes + subtrees * kLeastSubtreeBytes;
  const uint64_t size_bytes = (SizeGrid{layers, subtrees, false}.LeastBits() + 7) / 8;
  if (records + size_bytes > in->left()) {
    in->Fail(std::to_string(layers) + " layers of " + std::to_string(subtrees) +
             " subtrees need at least " + std::to_string(records + size_bytes) +
             " bytes of table, " + std::to_string(in->left()) + " are left");
  }
  table->layers.resize(layers);
  table->subtrees.resize(subtrees);
}

}  // namespace

std::vector<uint8_t> EncodeTable(const FileTable& table) {
  const std::string fault = TableFault(table);
  if (!fault.empty()) throw Failure(ErrorKind::kInternal, "table to write: " + fault);
  ByteWriter out;
  out.Varint(table.vertices);
  out.Varint(table.faces);
  out.U8(table.coordinate_type);
  const bool is_short = HasShortOrigin(table);
  out.U8(is_short ? 1 : 0);
  for (const double origin : table.origin) {
    if (is_short) {
      out.F32(static_cast<float>(origin));
    } else {
      out.F64(origin);
    }
  }
  out.F64(table.unit);
  for (const int32_t extent : table.extent) out.Varint(static_cast<uint64_t>(extent));
  out.F64(table.tolerance);
  out.Varint(table.codec.size());
  out.Bytes(table.codec);
  out.U64(table.digest.vertices);
  out.U64(table.digest.faces);
  for (const uint64_t bits : table.kind_bits) out.Varint(bits);
  out.Varint(table.layers.size());
  out.Varint(table.subtrees.size());
  WriteLayers(table, &out);
  for (const SubtreeRecord& subtree : table.subtrees) WriteSubtree(subtree, &out);
  WriteSizes(table.segment_bytes, GridOf(table), &out);
  return std::move(out).Take();
}

FileTable DecodeTable(std::span<const uint8_t> bytes, std::string_view file, uint64_t offset) {
  ByteReader in(bytes, file, offset);
  FileTable table;
  table.vertices = in.VarintUpTo(kMaxCount, "number of vertices");
  table.faces = in.VarintUpTo(kMaxCount, "number of faces");
  table.coordinate_type = in.U8();
  const uint8_t is_short = in.U8();
  if (is_short > 1) in.Fail("precision of the lattice's origin neither 0 nor 1");
  for (double& origin : table.origin) {
    origin = is_short == 1 ? static_cast<double>(in.F32()) : in.F64();
  }
  if (is_short == 0 && HasShortOrigin(table))
    in.Fail("origin of the lattice longer than it need be");
  table.unit = in.F64();
  for (int32_t& extent : table.extent) {
    extent = static_cast<int32_t>(in.VarintUpTo(kMaxCoordinate, "extent of the lattice"));
  }
  table.tolerance = in.F64();
  const auto codec = in.Bytes(in.VarintUpTo(in.left(), "length of the coder's settings"));
  table.codec.assign(codec.begin(), codec.end());
  table.digest.vertices = in.U64();
  table.digest.faces = in.U64();
  for (uint64_t& bits : table.kind_bits) bits = in.Varint();
  ReadCounts(&in, &table);
  ReadLayers(&in, &table);
  for (size_t i = 0; i < table.subtrees.size(); ++i) {
    table.subtrees[i] = ReadSubtree(i, table, &in);
  }
  // The records may have taken more than their least, so the sizes are checked again.
  const SizeGrid grid = GridOf(table);
  if (grid.LeastBits() > uint64_t{8} * in.left())
    in.Fail("fewer bytes left than the segment sizes need");
  table.segment_bytes = ReadSizes(grid, &in);
  if (in.left() > 0) in.Fail(std::to_string(in.left()) + " bytes after the segment sizes");
  const std::string fault = TableFault(table);
  if (!fault.empty()) throw Failure(ErrorKind::kCorrupt, std::string(file) + ": table: " + fault);
  return table;
}

}  // namespace folprom::io
