#include "io/container/size_code.h"

#include <gtest/gtest.h>

#include "folprom/result.h"
#include "io/container/file_table.h"
#include "samples.h"

namespace folprom::io {
namespace {

std::vector<uint8_t> Coded(std::span<const uint64_t> sizes, const SizeGrid& grid) {
  ByteWriter out;
  BitWriter bits(&out);
  WriteSizes(sizes, grid, &bits);
  bits.Finish();
  return std::move(out).Take();
}

/// Appends the sizes that the bytes hold.
void Decode(std::span<const uint8_t> bytes, const SizeGrid& grid, std::vector<uint64_t>* sizes) {
  ByteReader in(bytes, "file", 0);
  BitReader bits(&in);
  ReadSizes(grid, in, &bits, sizes);
  bits.Finish();
  EXPECT_EQ(in.left(), 0u);
}

std::vector<uint8_t> Coded(std::span<const uint64_t> sizes, size_t layers, size_t subtrees) {
  return Coded(sizes, SizeGrid{layers, subtrees, true});
}

std::vector<uint64_t> Decoded(std::span<const uint8_t> bytes, size_t layers, size_t subtrees) {
  std::vector<uint64_t> sizes;
  Decode(bytes, {layers, subtrees, true}, &sizes);
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
  const auto bytes = Coded(sizes, SizeGrid{2, 2, false});
  EXPECT_LT(bytes.size(), Coded(sizes, 2, 2).size());
  std::vector<uint64_t> back;
  Decode(bytes, {2, 2, false}, &back);
  EXPECT_EQ(back, sizes);
}

TEST(SizeCode, PredictsLayersByThoseOfAnEarlierRun) {
  const FileTable table = ScanLikeTable();
  const std::span<const uint64_t> sizes = table.segment_bytes;
  const auto first = Coded(sizes.first(20 * 8 * 2), 20, 8);
  const auto rest = Coded(sizes, SizeGrid{10, 8, true});
  EXPECT_LE(first.size() + rest.size(), Coded(sizes, 30, 8).size() + 4);
  std::vector<uint64_t> back;
  Decode(first, {20, 8, true}, &back);
  Decode(rest, {10, 8, true}, &back);
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
