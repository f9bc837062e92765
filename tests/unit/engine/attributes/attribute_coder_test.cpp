#include "engine/attributes/attribute_coder.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <vector>

#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

using enum ScalarType;

/// What a split adds to a complex: a vertex, perhaps joined to its parent, perhaps a face.
struct Step {
  Int3 position;
  uint32_t parent = 0;
  bool joined = false;
  std::optional<uint32_t> third;
};

/// A complex that grows vertex by vertex.
class Growth {
 public:
  NewVertex Add(const Step& step) {
    const uint32_t vertex = complex_.AddVertex();
    positions_.push_back(step.position);
    if (step.joined) complex_.AddEdge(step.parent, vertex);
    if (step.third) {
      complex_.AddEdge(*step.third, vertex);
      complex_.AddFace(step.parent, *step.third, vertex);
    }
    return {complex_, positions_, vertex, step.parent};
  }

 private:
  Complex complex_;
  std::vector<Int3> positions_;
};

class AttributeCoderTest : public ::testing::Test {
 protected:
  static constexpr uint32_t kVertices = 250;

  AttributeCoderTest() {
    for (const auto type : {kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64}) {
      spans_.push_back({type, 0, LargestOrdered(type)});
    }
    for (const auto type : {kFloat32, kFloat64}) {
      for (uint32_t axis = 1; axis <= 3; ++axis) {
        spans_.push_back({type, 0, LargestOrdered(type), axis});
      }
    }
    spans_.push_back({kUint16, 7, 7});
  }

  int32_t Coordinate(uint32_t bits) {
    return static_cast<int32_t>(random_() & ((uint64_t{1} << bits) - 1));
  }

  void MakeSteps() {
    steps_.assign(1, {});
    for (uint32_t v = 1; v < kVertices; ++v) {
      Step step;
      step.position = {Coordinate(7), Coordinate(7), Coordinate(random_() % 2 == 0 ? 29 : 1)};
      step.parent = static_cast<uint32_t>(random_() % v);
      step.joined = random_() % 4 > 0;
      const auto third = static_cast<uint32_t>(random_() % v);
      if (third != step.parent && random_() % 2 == 0) step.third = third;
      steps_.push_back(step);
    }
  }

  /// Any bits, among them those of every kind of NaN; some rows as others are, or nearly so.
  void MakeRows() {
    rows_.clear();
    const size_t stride = AttributeCoder(spans_).stride();
    for (uint32_t v = 0; v < kVertices; ++v) {
      std::vector<uint8_t> row(stride);
      for (uint8_t& byte : row) byte = static_cast<uint8_t>(random_());
      if (v > 0 && random_() % 2 == 0) {
        row = rows_[random_() % v];
        if (random_() % 2 == 0) row[random_() % stride] ^= 1;
      }
      if (random_() % 9 == 0) row.assign(stride, random_() % 2 == 0 ? 0 : 255);
      row[stride - 2] = 7;  // the constant
      row[stride - 1] = 0;
      rows_.push_back(row);
    }
  }

  /// Codes all vertices; rows: encoder only.
  template <class Coder>
  std::vector<uint8_t> Code(Coder& coder) {
    AttributeCoder attributes(spans_);
    Growth growth;
    growth.Add(steps_[0]);
    const auto row = [&](uint32_t v) { return Coder::kEncoding ? rows_[v].data() : nullptr; };
    attributes.CodeRoot(coder, row(0));
    for (uint32_t v = 1; v < kVertices; ++v) {
      attributes.CodeNew(coder, growth.Add(steps_[v]), row(v), nullptr);
    }
    return attributes.Values();
  }

  std::mt19937_64 random_{1};
  std::vector<ValueSpan> spans_;
  std::vector<Step> steps_;
  std::vector<std::vector<uint8_t>> rows_;
};

TEST_F(AttributeCoderTest, AnyBitsComeBack) {
  for (int round = 0; round < 10; ++round) {
    MakeSteps();
    MakeRows();
    std::vector<uint8_t> expected;
    for (const auto& row : rows_) expected.insert(expected.end(), row.begin(), row.end());
    BitEncoder encoder;
    EXPECT_EQ(Code(encoder), expected);
    const std::vector<uint8_t> segment = encoder.TakeSegment();
    BitDecoder decoder;
    decoder.StartSegment(segment);
    EXPECT_EQ(Code(decoder), expected);
    decoder.FinishSegment();
  }
}

TEST_F(AttributeCoderTest, NoiseIsDecodedOrRefused) {
  for (int round = 0; round < 30; ++round) {
    MakeSteps();
    std::vector<uint8_t> noise(random_() % 30000);
    for (uint8_t& byte : noise) byte = static_cast<uint8_t>(random_());
    BitDecoder decoder;
    decoder.StartSegment(noise);
    try {
      EXPECT_EQ(Code(decoder).size(), kVertices * AttributeCoder(spans_).stride());
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.error().kind, ErrorKind::kCorrupt);
    }
  }
}

TEST_F(AttributeCoderTest, RootsBeyondTheRangeAreCorrupt) {
  spans_ = {{kUint8, 10, 14}};  // 5 values in three bits
  steps_.assign(1, {});
  BitEncoder encoder;
  for (const bool bit : {true, true, true}) encoder.Code(32768, bit);
  const std::vector<uint8_t> segment = encoder.TakeSegment();
  BitDecoder decoder;
  decoder.StartSegment(segment);
  AttributeCoder attributes(spans_);
  EXPECT_THROW(attributes.CodeRoot(decoder, nullptr), Failure);
}

}  // namespace
}  // namespace folprom
