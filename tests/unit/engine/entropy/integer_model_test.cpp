#include "engine/entropy/integer_model.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

std::vector<uint8_t> CodedUnsigned(const std::vector<uint32_t>& values) {
  IntegerModel<2> model({3, 2});
  BitEncoder encoder;
  for (size_t i = 0; i < values.size(); ++i) {
    uint32_t context = static_cast<uint32_t>(i);
    EXPECT_EQ(model.CodeUnsigned(encoder, {context % 3, context % 2}, values[i]), values[i]);
  }
  return encoder.TakeSegment();
}

void ExpectUnsigned(const std::vector<uint32_t>& values) {
  const auto bytes = CodedUnsigned(values);
  IntegerModel<2> model({3, 2});
  BitDecoder decoder;
  decoder.StartSegment(bytes);
  for (size_t i = 0; i < values.size(); ++i) {
    uint32_t context = static_cast<uint32_t>(i);
    ASSERT_EQ(model.CodeUnsigned(decoder, {context % 3, context % 2}, 0), values[i]) << i;
  }
}

void ExpectSigned(const std::vector<int32_t>& values) {
  IntegerModel<1> written({1}), read({1});
  BitEncoder encoder;
  for (int32_t value : values) EXPECT_EQ(written.CodeSigned(encoder, {0}, value), value);
  const auto bytes = encoder.TakeSegment();
  BitDecoder decoder;
  decoder.StartSegment(bytes);
  for (size_t i = 0; i < values.size(); ++i) {
    ASSERT_EQ(read.CodeSigned(decoder, {0}, 0), values[i]) << i;
  }
}

TEST(IntegerModel, GivesBackTheEdgesOfEachOctave) {
  std::vector<uint32_t> values{0, 1, 2};
  for (int bit = 2; bit < 32; ++bit) {
    const uint32_t power = uint32_t{1} << bit;
    values.insert(values.end(), {power - 2, power - 1, power, power + 1});
  }
  values.insert(values.end(), {0xfffffffdu, 0xfffffffeu});
  ExpectUnsigned(values);
}

TEST(IntegerModel, GivesBackRandomValuesOfEverySize) {
  std::mt19937_64 random(1);
  std::vector<uint32_t> values;
  for (int i = 0; i < 20000; ++i) {
    values.push_back(static_cast<uint32_t>(random() >> (32 + random() % 32)) % 0xffffffffu);
  }
  ExpectUnsigned(values);
}

TEST(IntegerModel, GivesBackSignedValuesToTheEndOfTheRange) {
  ExpectSigned({0, 1, -1, 2, -2, 1000, -1000, 0x3fffffff, -0x3fffffff, 0x7ffffffe, -0x7ffffffe, 0});
}

TEST(IntegerModel, GivesBackRandomSignedValues) {
  std::mt19937_64 random(2);
  std::vector<int32_t> values;
  for (int i = 0; i < 20000; ++i) {
    int32_t size = static_cast<int32_t>((random() & 0x7fffffff) >> (random() % 31));
    if (size == 0x7fffffff) size = 0;
    values.push_back(random() % 2 == 0 ? size : -size);
  }
  ExpectSigned(values);
}

TEST(IntegerModel, RefusesASignedValueBeyondTheRange) {
  // The unsigned part of a signed value, written by its own means.
  for (uint32_t size : {0x7ffffffeu, 0x7fffffffu, 0xfffffffeu}) {
    IntegerModel<1> model({1});
    BitEncoder encoder;
    encoder.Code(32768, true);  // not zero
    encoder.Code(32768, false);
    model.CodeUnsigned(encoder, {0}, size);
    const auto bytes = encoder.TakeSegment();
    IntegerModel<1> read({1});
    BitDecoder decoder;
    decoder.StartSegment(bytes);
    try {
      read.CodeSigned(decoder, {0}, 0);
      FAIL() << size;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.error().kind, ErrorKind::kCorrupt);
    }
  }
}

TEST(IntegerModel, LearnsASkewedDistribution) {
  std::mt19937_64 random(3);
  std::geometric_distribution<uint32_t> draw(0.5);  // two bits a value
  IntegerModel<1> model({1});
  BitEncoder encoder;
  constexpr size_t kCount = 50000;
  for (size_t i = 0; i < kCount; ++i) model.CodeUnsigned(encoder, {0}, draw(random));
  EXPECT_LT(static_cast<double>(encoder.TakeSegment().size()) * 8 / kCount, 2.06);
}

}  // namespace
}  // namespace folprom
