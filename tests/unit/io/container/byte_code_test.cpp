#include "io/container/byte_code.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "folprom/result.h"

namespace folprom::io {
namespace {

uint64_t VarintOf(const std::vector<uint8_t>& bytes) {
  ByteReader in(bytes, "file", 0);
  const uint64_t value = in.Varint();
  EXPECT_EQ(in.left(), 0u);
  return value;
}

TEST(ByteCode, BringsBackVarintsOfEveryWidth) {
  for (int shift = 0; shift < 64; ++shift) {
    for (const uint64_t value :
         {uint64_t{1} << shift, (uint64_t{1} << shift) - 1, UINT64_MAX >> shift}) {
      ByteWriter out;
      out.Varint(value);
      EXPECT_EQ(VarintOf(std::move(out).Take()), value);
    }
  }
}

TEST(ByteCode, RejectsVarintsThatAreLongOrCut) {
  const std::vector<uint8_t> largest = {0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 1};
  EXPECT_EQ(VarintOf(largest), UINT64_MAX);
  std::vector<uint8_t> above = largest;
  above.back() = 2;
  EXPECT_THROW(VarintOf(above), Failure);
  above.back() = 0x81;
  above.push_back(0);
  EXPECT_THROW(VarintOf(above), Failure);
  EXPECT_THROW(VarintOf({0x80, 0x00}), Failure);
  EXPECT_THROW(VarintOf({0x80}), Failure);
  EXPECT_THROW(VarintOf({}), Failure);
}

TEST(ByteCode, KeepsEveryBitOfAFloat) {
  for (const double value : {0.1, -0.0, 1e-310, 1e308, std::numeric_limits<double>::infinity()}) {
    ByteWriter out;
    out.F64(value);
    const auto bytes = std::move(out).Take();
    ASSERT_EQ(bytes.size(), 8u);
    ByteReader in(bytes, "file", 0);
    EXPECT_EQ(std::bit_cast<uint64_t>(in.F64()), std::bit_cast<uint64_t>(value));
  }
}

TEST(ByteCode, ZigZagTurnsBackForAllDifferences) {
  EXPECT_EQ(ZigZag(0), 0u);
  EXPECT_EQ(ZigZag(UINT64_MAX), 1u);
  EXPECT_EQ(ZigZag(1), 2u);
  for (const uint64_t value :
       {uint64_t{0}, uint64_t{5}, UINT64_MAX, UINT64_MAX >> 1, (UINT64_MAX >> 1) + 1}) {
    EXPECT_EQ(UnZigZag(ZigZag(value)), value);
  }
}

TEST(ByteCode, FirstBitIsTheHighestOfTheByte) {
  ByteWriter out;
  BitWriter bits(&out);
  bits.Bits(1, 1);
  bits.Bits(0, 2);
  bits.Bits(0b10110, 5);
  bits.Bits(3, 2);
  bits.Finish();
  EXPECT_EQ(std::move(out).Take(), (std::vector<uint8_t>{0x96, 0xc0}));
}

TEST(ByteCode, RejectsFillBitsAndMissingBits) {
  const std::vector<uint8_t> bytes = {0x21};
  ByteReader in(bytes, "file", 0);
  BitReader bits(&in);
  EXPECT_EQ(bits.Zeros(2), 2);
  EXPECT_THROW(bits.Finish(), Failure);
  EXPECT_EQ(bits.Bits(5), 1u);
  EXPECT_NO_THROW(bits.Finish());
  EXPECT_THROW(bits.Bits(1), Failure);
}

TEST(ByteCode, NamesFileAndByteAndReason) {
  const std::vector<uint8_t> bytes = {7, 0x80, 0};
  ByteReader in(bytes, "scan.folp", 14);
  in.U8();
  try {
    in.Varint();
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.error().kind, ErrorKind::kCorrupt);
    EXPECT_EQ(failure.error().message,
              "scan.folp: byte 15 (in the table): varint with needless bytes");
  }
}

}  // namespace
}  // namespace folprom::io
