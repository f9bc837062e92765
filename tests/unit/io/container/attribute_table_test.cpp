// The attributes and remarks of a table: what is written comes back, what is wrong is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "folprom/result.h"
#include "io/container/table_code.h"
#include "samples.h"

namespace folprom::io {
namespace {

using enum ScalarType;

FileTable Table() {
  FileTable table = RandomTable(3, true);
  table.schema.attributes = {{"red", kUint8}, {"green", kUint8}, {"quality", kFloat64}};
  table.schema.before_position = 2;
  table.attribute_ranges = {{3, 200}, {7, 7}, {0, ~uint64_t{0}}};
  table.attribute_bits = {12345, 0, 99};
  table.remarks = {"comment one", "obj_info num_cols 5"};
  return table;
}

std::vector<uint8_t> OnlyTable(const FileTable& table) {
  auto tables = EncodeTables(table);
  EXPECT_EQ(tables.size(), 1u);
  return tables[0].bytes;
}

Result<FileTable> Read(std::span<const uint8_t> bytes) {
  try {
    TableDecoder decoder("scan.folp");
    decoder.Decode(bytes, 14);
    return std::move(decoder).TakeTable();
  } catch (const Failure& failure) {
    return failure.error();
  }
}

/// The table with bytes of it replaced is corrupt for that reason.
void ExpectRefused(const std::string& from, const std::string& to, const std::string& reason) {
  std::vector<uint8_t> bytes = OnlyTable(Table());
  const std::vector<uint8_t> sought(from.begin(), from.end());
  const auto at = std::search(bytes.begin(), bytes.end(), sought.begin(), sought.end());
  ASSERT_NE(at, bytes.end()) << from;
  ASSERT_EQ(from.size(), to.size());
  std::copy(to.begin(), to.end(), at);
  const auto table = Read(bytes);
  ASSERT_FALSE(table.ok()) << to;
  EXPECT_EQ(table.error().kind, ErrorKind::kCorrupt);
  EXPECT_NE(table.error().message.find(reason), std::string::npos) << table.error().message;
}

TEST(AttributeTableTest, ComesBack) {
  const FileTable table = Table();
  EXPECT_TRUE(Read(OnlyTable(table)).value() == table);
  FileTable remarks = RandomTable(3, true);
  remarks.remarks = {"comment"};
  EXPECT_TRUE(Read(OnlyTable(remarks)).value() == remarks);
}

TEST(AttributeTableTest, NamesThatWouldBreakAHeaderAreRefused) {
  for (const char* name : {"r\nd", "r d", "r\td", "r\0d",
                           "r\x7f"
                           "d",
                           "r\xc3\xa9"}) {
    ExpectRefused("red", std::string(name, 3), "a name that no attribute can have");
  }
}

TEST(AttributeTableTest, NamesOfCoordinatesAndOfOthersAreRefused) {
  FileTable table = Table();
  for (const char* name : {"x", "y", "z", "", "green"}) {
    table.schema.attributes[0].name = name;
    EXPECT_NE(TableFault(table), "") << name;
    EXPECT_THROW(EncodeTables(table), Failure);
  }
  table.schema.attributes[0].name = std::string(255, 'n');
  EXPECT_EQ(TableFault(table), "");
  table.schema.attributes[0].name = std::string(256, 'n');
  EXPECT_NE(TableFault(table), "");
}

TEST(AttributeTableTest, TypesAndRangesThatDoNotExistAreRefused) {
  ExpectRefused(std::string("red\x01", 4), std::string("red\x08", 4), "type of an attribute");
  ExpectRefused(std::string("red\x01\x03\xc5\x01", 7), std::string("red\x01\x03\xfd\x01", 7),
                "range of an attribute");
  ExpectRefused(std::string("red\x01\x03\xc5\x01", 7), std::string("red\x01\x81\xc5\x01", 7), "");
  FileTable table = Table();
  table.attribute_ranges[0] = {5, 4};
  EXPECT_NE(TableFault(table), "");
  table.attribute_ranges[0] = {5, 256};
  EXPECT_NE(TableFault(table), "");
  table = Table();
  table.attribute_ranges.pop_back();
  EXPECT_NE(TableFault(table), "");
}

TEST(AttributeTableTest, StepsComeBackAndThoseThatCannotBeAreRefused) {
  FileTable table = Table();
  table.attribute_ranges[2] = {0, 1023, 0.25, -7};
  EXPECT_TRUE(Read(OnlyTable(table)).value() == table);
  const auto expect_fault = [](size_t attribute, const AttributeRange& range) {
    FileTable other = Table();
    other.attribute_ranges[attribute] = range;
    EXPECT_NE(TableFault(other), "");
  };
  expect_fault(0, {0, 7, 0.25, 0});  // of whole numbers
  expect_fault(2, {0, kMostSteps + 1, 0.25, 0});
  expect_fault(2, {0, 7, -0.25, 0});
  expect_fault(2, {0, 7, 1e308, 1e308});
  expect_fault(2, {0, 7, 0, 1});
}

TEST(AttributeTableTest, RemarksThatAreNoLinesOfAHeaderAreRefused) {
  ExpectRefused("comment one", "comment\none", "a remark that is no line");
  ExpectRefused("comment one", "comment\rone", "a remark that is no line");
  ExpectRefused("comment one", "element one", "a remark that is no line");
  ExpectRefused("comment one", "comments ne", "a remark that is no line");
  FileTable table = Table();
  table.remarks = {"comment " + std::string(9 << 20, 'a'), "comment " + std::string(9 << 20, 'b')};
  EXPECT_EQ(TableFault(table), "more than 16 MiB of remarks");
}

TEST(AttributeTableTest, AbsurdCountsAreRefusedBeforeAnythingIsAllocated) {
  const std::string count("\x03\x03red", 5);
  ExpectRefused(count, std::string("\xff\x03red", 5), "number of attributes");
  ExpectRefused(count, std::string("\x7f\x03red", 5), "");
  ExpectRefused(std::string("\x02\x0b"
                            "comment one",
                            13),
                std::string("\x7f\x0b"
                            "comment one",
                            13),
                "");
  ExpectRefused(std::string("\x0b"
                            "comment one",
                            12),
                std::string("\x7f"
                            "comment one",
                            12),
                "");
  ExpectRefused(std::string("\x02\x02\x0b"
                            "comment",
                            10),
                std::string("\x04\x02\x0b"
                            "comment",
                            10),
                "attributes before the position");
}

TEST(AttributeTableTest, EveryTruncationIsRefused) {
  const std::vector<uint8_t> bytes = OnlyTable(Table());
  for (size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(Read(std::span(bytes).first(size)).ok()) << size;
  }
}

TEST(AttributeTableTest, FlagsWithoutAttributesOrRemarksAreRefused) {
  FileTable bare = RandomTable(3, true);
  std::vector<uint8_t> with = OnlyTable(Table()), without = OnlyTable(bare);
  // The flags are the first byte in which they differ; nothing follows the coder's settings then.
  const auto [flags, other] = std::mismatch(with.begin(), with.end(), without.begin());
  ASSERT_EQ(*flags, *other | 2);
  *other = static_cast<uint8_t>(*other | 2);
  EXPECT_FALSE(Read(without).ok());
  *other = static_cast<uint8_t>(*other | 4);
  EXPECT_FALSE(Read(without).ok());
}

}  // namespace
}  // namespace folprom::io
