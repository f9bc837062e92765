#include "io/container/table_code.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <limits>
#include <numeric>
#include <random>

#include "folprom/result.h"
#include "io/container/byte_code.h"
#include "io/container/row_code.h"
#include "samples.h"

namespace folprom::io {
namespace {

Error FailureOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const Failure& failure) {
    return failure.error();
  }
  return {ErrorKind::kUsage, "no failure"};
}

FileTable Decoded(std::span<const CodedTable> tables) {
  TableDecoder decoder("file");
  for (size_t i = 0; i < tables.size(); ++i) {
    decoder.Decode(tables[i].bytes, 0);
    EXPECT_EQ(decoder.table().layers.size(), tables[i].end_layer);
    EXPECT_EQ(decoder.next_bytes(), i + 1 < tables.size() ? tables[i + 1].bytes.size() : 0);
  }
  EXPECT_EQ(decoder.layers_total(), decoder.table().layers.size());
  return decoder.table();
}

/// A table of few bytes has one part, as the file that it announces.
std::vector<uint8_t> EncodeTable(const FileTable& table) {
  auto tables = EncodeTables(table);
  EXPECT_EQ(tables.size(), 1u);
  return std::move(tables[0].bytes);
}

FileTable DecodeTable(std::span<const uint8_t> bytes) {
  TableDecoder decoder("scan.folp");
  decoder.Decode(bytes, 14);
  EXPECT_EQ(decoder.next_bytes(), 0u);
  return decoder.table();
}

void ExpectCorrupt(std::span<const uint8_t> bytes, const std::string& reason) {
  const Error error = FailureOf([&] { DecodeTable(bytes); });
  EXPECT_EQ(error.kind, ErrorKind::kCorrupt) << error.message;
  EXPECT_TRUE(error.message.starts_with("scan.folp: ")) << error.message;
  EXPECT_NE(error.message.find(reason), std::string::npos) << error.message;
}

/// The fields before the counts of layers and subtrees, for a mesh without vertices.
ByteWriter BeforeCounts(uint64_t vertices = 0, uint64_t extent = 0) {
  ByteWriter out;
  out.Varint(vertices);
  out.Varint(0);
  out.U8(6);
  out.U8(1);
  for (int i = 0; i < 3; ++i) out.F32(0);
  out.F64(1);
  for (int i = 0; i < 3; ++i) out.Varint(extent);
  out.Varint(0);
  return out;
}

/// Rows of no layer: their orders.
void NoLayers(bool seams, ByteWriter* out) {
  out->Varint(0);
  BitWriter bits(out);
  bits.Bits(0, (seams ? 5 : 4) * kRowParameterBits);
  bits.Finish();
}

/// A layer of no subtrees, as its three numbers are coded.
void OneLayer(const std::array<uint64_t, 3>& numbers, ByteWriter* out) {
  out->Varint(1);
  BitWriter bits(out);
  for (const uint64_t& number : numbers) WriteRow(std::span(&number, 1), &bits);
  WriteRow({}, &bits);
  bits.Finish();
}

/// The fields behind the sizes of the last layer.
void Finish(ByteWriter* out) {
  out->F64(0);
  out->U64(0);
  out->U64(0);
  for (size_t i = 0; i < kBitKinds; ++i) out->Varint(0);
}

TEST(TableCode, BringsBackRandomTables) {
  for (uint64_t seed = 0; seed < 300; ++seed) {
    const FileTable table = RandomTable(seed, seed % 2 == 0);
    EXPECT_EQ(Decoded(EncodeTables(table)), table) << seed;
  }
}

TEST(TableCode, KeepsEveryBitOfFloats) {
  FileTable table = ExampleTable();
  table.origin = {-0.0, 1e-310, -1.7976931348623157e308};
  table.unit = 5e-324;
  table.layers[1].error_bound = std::bit_cast<float>(uint32_t{0x00010000});
  const FileTable back = DecodeTable(EncodeTable(table));
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(std::bit_cast<uint64_t>(back.origin[i]), std::bit_cast<uint64_t>(table.origin[i]));
  }
  EXPECT_EQ(back.unit, table.unit);
  EXPECT_EQ(back.layers[1].error_bound, table.layers[1].error_bound);
}

TEST(TableCode, AScanLikeTableIsSmall) {
  size_t bytes = 0;
  for (const CodedTable& table : EncodeTables(ScanLikeTable())) bytes += table.bytes.size();
  RecordProperty("bytes", static_cast<int>(bytes));
  EXPECT_LE(bytes, 2000u);
}

TEST(TableCode, RejectsEveryTruncationAndExtraBytes) {
  auto bytes = EncodeTable(ExampleTable());
  for (size_t size = 0; size < bytes.size(); ++size) {
    ExpectCorrupt(std::span(bytes).first(size), "");
  }
  bytes.push_back(0);
  ExpectCorrupt(bytes, "1 bytes after the end of the table");
}

TEST(TableCode, DamagedTablesGiveAnErrorOrAConsistentTable) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 20000; ++trial) {
    auto tables = EncodeTables(trial % 2 == 0 ? ExampleTable() : RandomTable(random() % 50, true));
    for (uint64_t i = 0; i <= random() % 3; ++i) {
      auto& bytes = tables[random() % tables.size()].bytes;
      bytes[random() % bytes.size()] = static_cast<uint8_t>(random());
    }
    try {
      TableDecoder decoder("file");
      for (const CodedTable& table : tables) {
        decoder.Decode(table.bytes, 0);
        EXPECT_EQ(TableFault(decoder.table()), "");
      }
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.error().kind, ErrorKind::kCorrupt);
    }
  }
}

TEST(TableCode, RejectsCountsThatTheBytesLeftCannotHold) {
  const auto with_counts = [](uint64_t layers, uint64_t subtrees, size_t bytes) {
    ByteWriter out = BeforeCounts(subtrees);
    out.Varint(layers);
    out.Varint(subtrees);
    for (uint64_t i = 0; i < subtrees && bytes > subtrees * 8; ++i) {
      out.Bytes(std::vector<uint8_t>{1, 0, 0, 0, 0, 0, 0, 0});
      bytes -= 8;
    }
    out.Varint(std::min(layers, uint64_t{4096}));
    out.Bytes(std::vector<uint8_t>(bytes));
    return std::move(out).Take();
  };
  ExpectCorrupt(with_counts(4097, 0, 100), "number of layers is 4097, at most 4096");
  ExpectCorrupt(with_counts(UINT64_MAX, 1, 100), "number of layers");
  ExpectCorrupt(with_counts(1, uint64_t{1} << 32, 100), "number of subtrees");
  ExpectCorrupt(with_counts(0, UINT32_MAX, 100), "bytes of table, 101 are left");
  ExpectCorrupt(with_counts(4096, UINT32_MAX, 100), "bytes of table, 102 are left");
  ExpectCorrupt(with_counts(4096, 0, 1538), "than the layers and segment sizes need");
  // Room for the records, not for 4,096 x 2,000 sizes.
  ExpectCorrupt(with_counts(4096, 2000, 4096 * 4 + 2000 * 8),
                "than the layers and segment sizes need");
}

TEST(TableCode, PartsWhereTheBytesHaveDoubled) {
  FileTable table = ScanLikeTable();
  const auto tables = EncodeTables(table);
  EXPECT_GE(tables.size(), 4u);
  const auto bytes_before = [&](size_t layer) {
    const auto sizes = std::span(table.segment_bytes).first(layer * table.subtrees.size() * 2);
    return std::accumulate(sizes.begin(), sizes.end(), uint64_t{0});
  };
  for (size_t i = 1; i + 1 < tables.size(); ++i) {
    const uint64_t begin = bytes_before(tables[i - 1].end_layer);
    EXPECT_GE(bytes_before(tables[i].end_layer), 2 * begin);
    EXPECT_LT(bytes_before(tables[i].end_layer - 1), 2 * begin + 256);
  }
}

TEST(TableCode, RejectsATableOfNoLayerAndLayersWithoutATable) {
  const auto table = [](uint64_t layers, uint64_t here, uint64_t next) {
    ByteWriter out = BeforeCounts();
    out.Varint(layers);
    out.Varint(0);
    if (here == 1) {
      OneLayer({}, &out);
    } else {
      out.Varint(here);
    }
    if (here < layers) out.Varint(next);
    return std::move(out).Take();
  };
  ExpectCorrupt(table(2, 0, 7), "a table of no layer");
  ExpectCorrupt(table(2, 1, 0), "layers are left, but no table of them");
  ExpectCorrupt(table(1, 2, 0), "number of layers of a table is 2, at most 1");
  TableDecoder decoder("file");
  decoder.Decode(table(2, 1, 7), 0);
  EXPECT_EQ(decoder.next_bytes(), 7u);
  EXPECT_EQ(decoder.layers_total(), 2u);
  EXPECT_EQ(decoder.table().layers.size(), 1u);
}

TEST(TableCode, RefusesSizesThatTakeMoreMemoryThanItMay) {
  const FileTable table = ExampleTable();
  const auto bytes = EncodeTable(table);
  const uint64_t needed = 48 * table.layers.size() * table.subtrees.size();
  TableDecoder enough("file", needed);
  enough.Decode(bytes, 0);
  EXPECT_EQ(enough.table(), table);
  TableDecoder little("file", needed - 1);
  try {
    little.Decode(bytes, 0);
    FAIL() << "more than it may";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.error().kind, ErrorKind::kLimit);
    EXPECT_EQ(failure.error().message.find("file: table: the sizes of "), 0u);
  }
}

TEST(TableCode, KeepsThatTheMeshIsASoup) {
  FileTable table = ExampleTable();
  table.is_soup = true;
  EXPECT_EQ(DecodeTable(EncodeTable(table)), table);
  table.faces = (table.vertices - 1) / 3;
  EXPECT_NE(TableFault(table), "");
  table = ExampleTable();
  table.is_soup = true;
  table.schema.attributes.push_back({"red", ScalarType::kUint8});
  table.attribute_ranges.push_back({0, 1});
  table.attribute_bits.push_back(0);
  EXPECT_NE(TableFault(table), "");
}

TEST(TableCode, RejectsSettingsLongerThanTheTable) {
  auto bytes = EncodeTable(ExampleTable());
  const size_t settings = 2 + 2 + 1 + 1 + 12 + 8 + 5;
  ASSERT_EQ(bytes[settings], 2);
  bytes[settings] = 0x7f;
  ExpectCorrupt(bytes, "length of the coder's settings is 127");
}

TEST(TableCode, ErrorBoundsAreRoundedUp) {
  for (double bound : {0.0, 1e-40, 0.1, 1.0, 3.14159, 1e30}) {
    const double next = static_cast<double>(NextErrorBound(bound));
    EXPECT_GT(next, bound);
    EXPECT_LE(next, bound * 1.008 + 1e-38);
    FileTable table = ExampleTable();
    table.layers[0].error_bound = NextErrorBound(bound);
    EXPECT_EQ(TableFault(table), "");
    EXPECT_EQ(DecodeTable(EncodeTable(table)), table);
  }
  FileTable table = ExampleTable();
  table.layers[0].error_bound = 0.1F;
  EXPECT_THROW(EncodeTables(table), Failure);
}

TEST(TableCode, RejectsASeamWhereNoSubtreeHasALowerNeighbour) {
  FileTable table = ExampleTable();
  EXPECT_EQ(TableFault(table), "");
  table.subtrees[1].lower_neighbours.clear();
  EXPECT_NE(TableFault(table).find("seam segment"), std::string::npos);
}

TEST(TableCode, RejectsNeighboursThatAreNotLower) {
  const auto with_neighbours = [](const std::vector<uint64_t>& steps) {
    ByteWriter out = BeforeCounts(3);
    out.Varint(0);
    out.Varint(3);
    for (int subtree = 0; subtree < 3; ++subtree) {
      out.Varint(1);
      for (int i = 0; i < 6; ++i) out.Varint(0);
      if (subtree < 2) out.Varint(0);
    }
    out.Varint(steps.size());
    for (const uint64_t step : steps) out.Varint(step);
    NoLayers(!steps.empty(), &out);
    Finish(&out);
    return std::move(out).Take();
  };
  EXPECT_EQ(DecodeTable(with_neighbours({0, 0})).subtrees[2].lower_neighbours,
            (std::vector<uint32_t>{0, 1}));
  EXPECT_EQ(DecodeTable(with_neighbours({1})).subtrees[2].lower_neighbours,
            (std::vector<uint32_t>{1}));
  ExpectCorrupt(with_neighbours({2}), "step to the next lower neighbour is 2, at most 1");
  ExpectCorrupt(with_neighbours({1, 0}), "lower neighbour not below its subtree");
  ExpectCorrupt(with_neighbours({0, 0, 0}), "number of lower neighbours is 3");
}

TEST(TableCode, RejectsBoxesOutsideTheExtent) {
  const auto with_box = [](uint64_t lo, uint64_t side) {
    ByteWriter out = BeforeCounts(1, 10);
    out.Varint(0);
    out.Varint(1);
    out.Varint(1);
    for (int axis = 0; axis < 3; ++axis) {
      out.Varint(lo);
      out.Varint(side);
    }
    out.Varint(0);
    NoLayers(false, &out);
    Finish(&out);
    return std::move(out).Take();
  };
  EXPECT_EQ(DecodeTable(with_box(4, 6)).subtrees[0].box_hi[2], 10);
  ExpectCorrupt(with_box(11, 0), "lower corner of a box is 11");
  ExpectCorrupt(with_box(4, 7), "side of a box is 7");
  ExpectCorrupt(with_box(4, UINT64_MAX), "side of a box");
}

TEST(TableCode, RejectsASubtreeWithoutVertices) {
  ByteWriter out = BeforeCounts();
  out.Varint(0);
  out.Varint(1);
  for (int i = 0; i < 8; ++i) out.Varint(0);
  NoLayers(false, &out);
  Finish(&out);
  ExpectCorrupt(std::move(out).Take(), "subtree 0: no vertices");
}

TEST(TableCode, RejectsVerticesThatTheSubtreesDoNotHave) {
  ByteWriter out = BeforeCounts(5);
  for (int i = 0; i < 2; ++i) out.Varint(0);
  NoLayers(false, &out);
  Finish(&out);
  ExpectCorrupt(std::move(out).Take(), "the subtrees have 0 vertices, the mesh 5");
}

TEST(TableCode, RejectsLayersThatContradictTheMesh) {
  const auto with_layer = [](float bound, uint64_t vertices, uint64_t faces_code) {
    ByteWriter out = BeforeCounts(0);
    out.Varint(1);
    out.Varint(0);
    OneLayer({ZigZag(std::bit_cast<uint32_t>(bound) >> 16), ZigZag(vertices), faces_code}, &out);
    Finish(&out);
    return std::move(out).Take();
  };
  EXPECT_EQ(DecodeTable(with_layer(1, 0, 4)).layers[0].faces, 2u);
  ExpectCorrupt(with_layer(1, 1, 0), "growth of a layer's vertices is 1, at most 0");
  ExpectCorrupt(with_layer(1, 0, 3), "number of a layer's faces");
  ExpectCorrupt(with_layer(-1, 0, 0), "layer 0: error bound");
  ByteWriter wide = BeforeCounts(0);
  wide.Varint(1);
  wide.Varint(0);
  OneLayer({ZigZag(0x10000), 0, 0}, &wide);
  ExpectCorrupt(std::move(wide).Take(), "error bound of more bits");
  ExpectCorrupt(with_layer(std::numeric_limits<float>::quiet_NaN(), 0, 0), "error bound");
}

TEST(TableCode, TakesFourBytesForAnOriginOfFloats) {
  FileTable table = ExampleTable();
  table.origin = {1e300, -0.0, 0.5};
  const size_t as_doubles = EncodeTable(table).size();
  table.origin = {static_cast<double>(0.1F), -0.0, 3e38};
  ASSERT_NE(static_cast<double>(static_cast<float>(table.origin[2])), table.origin[2]);
  EXPECT_EQ(EncodeTable(table).size(), as_doubles);
  table.origin[2] = static_cast<double>(3e38F);
  const auto bytes = EncodeTable(table);
  EXPECT_EQ(bytes.size(), as_doubles - 12);
  EXPECT_EQ(DecodeTable(bytes), table);
}

TEST(TableCode, RejectsALatticeThatIsNone) {
  FileTable table = ExampleTable();
  table.origin = {0.1, 0.2, 0.3};  // no floats
  const auto bytes = EncodeTable(table);
  const auto with_double = [&](size_t at, double value) {
    auto changed = bytes;
    ByteWriter number;
    number.F64(value);
    const auto coded = std::move(number).Take();
    std::copy(coded.begin(), coded.end(), changed.begin() + static_cast<ptrdiff_t>(at));
    return changed;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  ExpectCorrupt(with_double(6, nan), "origin of the lattice");
  ExpectCorrupt(with_double(14, infinity), "origin of the lattice");
  ExpectCorrupt(with_double(30, 0), "unit of the lattice");
  ExpectCorrupt(with_double(30, -1), "unit of the lattice");
  ExpectCorrupt(with_double(30, infinity), "unit of the lattice");
  const size_t tolerance = bytes.size() - 8 - 16 - 8;  // before digests and six varints
  ExpectCorrupt(with_double(tolerance, -1), "tolerance");
  ExpectCorrupt(with_double(tolerance, nan), "tolerance");
  auto as_floats = bytes;
  as_floats[5] = 32;
  ExpectCorrupt(as_floats, "flags of the mesh");
  auto infinite = EncodeTable(ExampleTable());
  infinite[8] = 0x80;
  infinite[9] = 0x7f;
  ExpectCorrupt(infinite, "origin of the lattice");
  ByteWriter needless;
  needless.Bytes(std::vector<uint8_t>{0, 0, 6, 0});
  for (int i = 0; i < 4; ++i) needless.F64(1);
  needless.Bytes(std::vector<uint8_t>(80));
  ExpectCorrupt(std::move(needless).Take(), "origin of the lattice longer than it need be");
  for (const int other : {0, 5, 8, 100}) {
    auto type = bytes;
    type[4] = static_cast<uint8_t>(other);
    ExpectCorrupt(type, "coordinate type " + std::to_string(other));
  }
  ByteWriter wide = BeforeCounts(0, uint64_t{1} << 30);
  ExpectCorrupt(std::move(wide).Take(), "extent of the lattice");
}

TEST(TableCode, RefusesToWriteWhatItWouldNotRead) {
  const auto fault_with = [](const std::function<void(FileTable&)>& change) {
    FileTable table = ExampleTable();
    change(table);
    const Error error = FailureOf([&] { EncodeTables(table); });
    EXPECT_EQ(error.kind, ErrorKind::kInternal);
    return error.message;
  };
  EXPECT_EQ(fault_with([](FileTable& t) { t.subtrees[1].lower_neighbours = {1}; }),
            "table to write: subtree 1: lower neighbour not below its subtree");
  fault_with([](FileTable& t) { t.subtrees[1].box_hi[0] = 1001; });
  fault_with([](FileTable& t) { t.subtrees[1].box_lo[1] = 301; });
  fault_with([](FileTable& t) { t.subtrees[1].box_lo[1] = -1; });
  fault_with([](FileTable& t) { t.extent[0] = -1; });
  fault_with([](FileTable& t) { t.extent[0] = 1 << 30; });
  fault_with([](FileTable& t) { t.vertices = 701; });
  fault_with([](FileTable& t) { t.layers[0].vertices = 701; });
  fault_with([](FileTable& t) { t.layers[1].vertices = 99; });
  fault_with([](FileTable& t) { t.layers[1].faces = kMaxCount + 1; });
  fault_with([](FileTable& t) { t.faces = kMaxCount + 1; });
  fault_with([](FileTable& t) { t.layers.resize(4097, t.layers[1]); });
  fault_with([](FileTable& t) { t.segment_bytes.pop_back(); });
  fault_with([](FileTable& t) { t.segment_bytes[0] = kMaxSegmentBytes + 1; });
}

}  // namespace
}  // namespace folprom::io
