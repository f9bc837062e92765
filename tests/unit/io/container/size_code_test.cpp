#include "io/container/size_code.h"

#include <gtest/gtest.h>

#include "folprom/result.h"
#include "io/container/file_table.h"
#include "samples.h"

namespace folprom::io {
namespace {

std::vector<uint8_t> Coded(std::span<const uint64_t> sizes, size_t layers, size_t subtrees) {
  ByteWriter out;
  WriteSizes(sizes, {layers, subtrees, true}, &out);
  return std::move(out).Take();
}

std::vector<uint64_t> Decoded(std::span<const uint8_t> bytes, size_t layers, size_t subtrees) {
  ByteReader in(bytes, "file", 0);
  std::vector<uint64_t> sizes;
  ReadSizes({layers, subtrees, true}, &in, &sizes);
  EXPECT_EQ(in.left(), 0u);
  return sizes;
}

TEST(SizeCode, BringsBackRandomSizes) {
  for (uint64_t seed = 0; seed < 200; ++seed) {
    const FileTable table = RandomTable(seed, seed % 2 == 0);
    const size_t layers = table.layers.size(), subtrees = table.subtrees.size();
    EXPECT_EQ(Decoded(Coded(table.segment_bytes, layers, subtrees), layers, subtrees),
              table.segment_bytes);
  }
}

TEST(SizeCode, BringsBackTheLargestJumps) {
  const uint64_t most = kMaxSegmentBytes;
  const std::vector<uint64_t> sizes = {most, 0, 0, most, 1, most, most, 0, 0, 0, most, most};
  EXPECT_EQ(Decoded(Coded(sizes, 3, 2), 3, 2), sizes);
  EXPECT_EQ(Decoded(Coded(sizes, 1, 6), 1, 6), sizes);
  EXPECT_EQ(Decoded(Coded(sizes, 6, 1), 6, 1), sizes);
}

TEST(SizeCode, NeverTakesFewerBitsThanTheBoundThatGuardsMemory) {
  const std::vector<uint64_t> empty(2 * 50 * 1000);
  EXPECT_EQ(Coded(empty, 50, 1000).size(), (SizeGrid{50, 1000, true}.LeastBits() + 7) / 8);
}

TEST(SizeCode, LeavesOutTheSeamsWhereThereAreNone) {
  const std::vector<uint64_t> sizes = {700, 0, 30, 0, 5, 0, 1000, 0};
  ByteWriter out, with;
  WriteSizes(sizes, {2, 2, false}, &out);
  WriteSizes(sizes, {2, 2, true}, &with);
  const auto bytes = std::move(out).Take();
  EXPECT_LT(bytes.size(), std::move(with).Take().size());
  ByteReader in(bytes, "file", 0);
  std::vector<uint64_t> back;
  ReadSizes({2, 2, false}, &in, &back);
  EXPECT_EQ(back, sizes);
}

TEST(SizeCode, PredictsLayersByThoseOfAnEarlierRun) {
  const FileTable table = ScanLikeTable();
  const std::span<const uint64_t> sizes = table.segment_bytes;
  ByteWriter first, rest;
  WriteSizes(sizes.first(20 * 8 * 2), {20, 8, true}, &first);
  WriteSizes(sizes, {10, 8, true}, &rest);
  const auto first_bytes = std::move(first).Take(), rest_bytes = std::move(rest).Take();
  EXPECT_LE(first_bytes.size() + rest_bytes.size(), Coded(sizes, 30, 8).size() + 1);
  std::vector<uint64_t> back;
  for (const auto& [bytes, layers] : {std::pair(first_bytes, 20u), {rest_bytes, 10u}}) {
    ByteReader in(bytes, "file", 0);
    ReadSizes({layers, 8, true}, &in, &back);
    EXPECT_EQ(in.left(), 0u);
  }
  EXPECT_EQ(back, table.segment_bytes);
}

TEST(SizeCode, RejectsSizesBeyondTheLimit) {
  // Row parameter 0, then 34 zero bits and a one: a code of 35 bits.
  ByteWriter out;
  BitWriter bits(&out);
  bits.Bits(0, 5 + 34);
  bits.Bits(UINT64_MAX, 35);
  bits.Finish();
  EXPECT_THROW(Decoded(std::move(out).Take(), 1, 1), Failure);
  // A size of -1: code 1 in order 0 is "010".
  const std::vector<uint8_t> negative = {0b00000'010, 0};
  EXPECT_THROW(Decoded(negative, 1, 1), Failure);
}

TEST(SizeCode, ScanLikeSizesTakeLessThanTenBitsEach) {
  const FileTable table = ScanLikeTable();
  const size_t bytes = Coded(table.segment_bytes, 30, 8).size();
  RecordProperty("bytes", static_cast<int>(bytes));
  EXPECT_LT(bytes * 8, table.segment_bytes.size() * 10);
}

}  // namespace
}  // namespace folprom::io
