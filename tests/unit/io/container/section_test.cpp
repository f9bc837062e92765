// What follows the last layer: sections in the tables, their place, their blocks.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "io/container/block_code.h"
#include "io/container/reader.h"
#include "io/container/table_code.h"
#include "tests/unit/io/container/samples.h"

namespace folprom::io {
namespace {

FileTable TableWithSections() {
  FileTable table = ExampleTable();
  table.sections[0] = SectionRecord{1000, 0x0123456789abcdef};
  table.sections[1] = SectionRecord{0, 7};
  table.polygons = table.faces / 2;
  table.largest_face = 4;
  return table;
}

FileTable Decoded(const FileTable& table) {
  TableDecoder decoder("scan.folp");
  for (const CodedTable& coded : EncodeTables(table)) decoder.Decode(coded.bytes, 0);
  return std::move(decoder).TakeTable();
}

TEST(Sections, ComeBackFromTheTables) {
  const FileTable table = TableWithSections();
  EXPECT_EQ(Decoded(table), table);
  FileTable order_alone = table;
  order_alone.sections[1].reset();
  order_alone.largest_face = 3;
  EXPECT_EQ(Decoded(order_alone), order_alone);
}

TEST(Sections, OfWhichATableContradictsItselfAreAFault) {
  FileTable table = TableWithSections();
  table.polygons = table.faces + 1;
  EXPECT_NE(TableFault(table), "");
  table = TableWithSections();
  table.sections = {};
  EXPECT_NE(TableFault(table), "");
  table = TableWithSections();
  table.sections[1].reset();
  EXPECT_NE(TableFault(table), "");
}

FileTable TableWithFaceValues() {
  FileTable table = TableWithSections();
  table.sections[2] = SectionRecord{5, 6};
  table.face_schema.attributes = {{"red", ScalarType::kUint8, 0},
                                  {"texcoord", ScalarType::kFloat32, 2}};
  table.face_schema.before_indices = 1;
  table.face_ranges = {{3, 200}, {7, 7}, {0, 0xffffffff}};
  return table;
}

TEST(Sections, OfFaceValuesComeBackFromTheTables) {
  FileTable table = TableWithFaceValues();
  EXPECT_EQ(Decoded(table), table);
  table.remarks = {"comment one"};
  EXPECT_EQ(Decoded(table), table);
}

TEST(Sections, OfFaceValuesThatCannotBeAreAFault) {
  const auto expect_fault = [](auto change) {
    FileTable table = TableWithFaceValues();
    change(table);
    EXPECT_NE(TableFault(table), "");
    EXPECT_THROW(EncodeTables(table), Failure);
  };
  EXPECT_EQ(TableFault(TableWithFaceValues()), "");
  expect_fault([](FileTable& table) { table.sections[2].reset(); });
  expect_fault([](FileTable& table) {
    table.face_schema = {};
    table.face_ranges.clear();
  });
  expect_fault([](FileTable& table) { table.face_ranges.pop_back(); });
  expect_fault([](FileTable& table) { table.face_ranges[0] = {5, 256}; });
  expect_fault([](FileTable& table) { table.face_ranges[0] = {5, 4}; });
  expect_fault([](FileTable& table) { table.face_schema.before_indices = 3; });
  expect_fault([](FileTable& table) { table.face_schema.attributes[0].name = "texcoord"; });
  expect_fault([](FileTable& table) { table.face_schema.attributes[0].name = "vertex_index"; });
  expect_fault([](FileTable& table) { table.face_schema.attributes[0].name = "a b"; });
  expect_fault([](FileTable& table) {
    table.face_schema.attributes[1].per_corner = kMostPerCorner + 1;
    table.face_ranges.resize(kMostPerCorner + 2);
  });
  expect_fault([](FileTable& table) {
    for (int i = 0; i < 33; ++i) {
      table.face_schema.attributes.push_back({std::to_string(i), ScalarType::kFloat64, 0});
      table.face_ranges.emplace_back();
    }
  });
}

TEST(Sections, AreReadBlockByBlock) {
  std::vector<uint8_t> section = FramedBlock(std::vector<uint8_t>{1, 2, 3});
  const std::vector<uint8_t> second = FramedBlock({});
  section.insert(section.end(), second.begin(), second.end());
  BlockReader blocks(section, "scan.folp: order: ");
  const auto first = blocks.Next();
  EXPECT_EQ(std::vector<uint8_t>(first.begin(), first.end()), (std::vector<uint8_t>{1, 2, 3}));
  EXPECT_TRUE(blocks.Next().empty());
  EXPECT_TRUE(blocks.AtEnd());
}

TEST(Sections, RefuseABlockThatIsCutOrDamaged) {
  const std::vector<uint8_t> block = FramedBlock(std::vector<uint8_t>{1, 2, 3});
  for (size_t size = 0; size < block.size(); ++size) {
    EXPECT_THROW(BlockReader(std::span(block).first(size), "").Next(), Failure);
  }
  for (size_t bit = 0; bit < 8 * block.size(); ++bit) {
    std::vector<uint8_t> damaged = block;
    damaged[bit / 8] = static_cast<uint8_t>(damaged[bit / 8] ^ 1u << bit % 8);
    EXPECT_THROW(BlockReader(damaged, "").Next(), Failure) << bit;
  }
}

}  // namespace
}  // namespace folprom::io
