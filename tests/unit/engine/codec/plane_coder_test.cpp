#include "engine/codec/plane_coder.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/codec/plane_census.h"
#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

using Values = std::array<std::vector<int32_t>, 3>;

std::vector<int32_t> Multiples(int32_t first, int32_t step, int32_t count) {
  std::vector<int32_t> values;
  for (int32_t i = 0; i < count; ++i) values.push_back(first + i * step);
  return values;
}

/// Codes there and back; returns the bytes.
size_t ExpectBack(const Int3& lo, const Int3& hi, const Values& values) {
  const auto planes = std::make_shared<CoordinatePlanes>(values);
  BitEncoder encoder;
  PlaneCoder(lo, hi).Code(encoder, planes);
  const std::vector<uint8_t> bytes = encoder.TakeSegment();
  BitDecoder decoder;
  decoder.StartSegment(bytes);
  const auto decoded = PlaneCoder(lo, hi).Code(decoder, nullptr);
  decoder.FinishSegment();
  EXPECT_TRUE(decoded != nullptr);
  for (uint32_t axis = 0; decoded != nullptr && axis < 3; ++axis) {
    const auto on = decoded->On(axis);
    EXPECT_EQ(std::vector<int32_t>(on.begin(), on.end()), values[axis]) << axis;
  }
  return bytes.size();
}

TEST(PlaneCoder, GivesPlanesBack) {
  constexpr int32_t kMost = (1 << 30) - 1;
  ExpectBack({0, 0, 0}, {9, 9, 9}, {{{0, 1, 2, 3, 9}, {}, {9}}});
  ExpectBack({0, 0, 0}, {kMost, kMost, kMost}, {{{0, kMost}, {kMost}, {0, 1, kMost - 1, kMost}}});
  ExpectBack({1000, 2000, 0}, {1500, 2000, 5}, {{{1000, 1007, 1499, 1500}, {2000}, {}}});
}

TEST(PlaneCoder, CostsLittleWhereTheyAreEvenlySpaced) {
  EXPECT_LE(ExpectBack({0, 0, 0}, {4095, 4095, 1 << 24},
                       {Multiples(3, 7, 500), Multiples(0, 7, 400), Multiples(11, 3511, 2000)}),
            80u);
}

TEST(PlaneCoder, SaysThatThereAreNone) {
  BitEncoder encoder;
  EXPECT_EQ(PlaneCoder({0, 0, 0}, {9, 9, 9}).Code(encoder, nullptr), nullptr);
  EXPECT_LE(encoder.TakeSegment().size(), 1u);
}

TEST(PlaneCoder, RefusesPlanesOutsideTheBox) {
  BitEncoder encoder;
  const auto planes = std::make_shared<CoordinatePlanes>(Values{{{0, 500}, {}, {}}});
  PlaneCoder({0, 0, 0}, {999, 9, 9}).Code(encoder, planes);
  const std::vector<uint8_t> bytes = encoder.TakeSegment();
  BitDecoder decoder;
  decoder.StartSegment(bytes);
  EXPECT_THROW(PlaneCoder({0, 0, 0}, {499, 9, 9}).Code(decoder, nullptr), Failure);
}

TEST(PlaneCoder, GivesPlanesInTheBoxOrFailsOnAnyBytes) {
  std::mt19937 random(2);
  for (int i = 0; i < 3000; ++i) {
    std::vector<uint8_t> bytes(random() % 40 + 1);
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random());
    bytes[0] |= 1;
    BitDecoder decoder;
    decoder.StartSegment(bytes);
    try {
      const auto planes = PlaneCoder({5, 5, 5}, {900, 90, 1 << 29}).Code(decoder, nullptr);
      for (uint32_t axis = 0; planes != nullptr && axis < 3; ++axis) {
        for (size_t p = 0; p < planes->On(axis).size(); ++p) {
          EXPECT_GE(planes->On(axis)[p], p == 0 ? 5 : planes->On(axis)[p - 1] + 1);
          EXPECT_LE(planes->On(axis)[p], axis == 0 ? 900 : (axis == 1 ? 90 : 1 << 29));
        }
      }
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.error().kind, ErrorKind::kCorrupt);
    }
  }
}

std::vector<Int3> Scattered(uint32_t count, int32_t extent, int32_t voxel) {
  std::mt19937 random(3);
  const auto any = [&] { return static_cast<int32_t>(random() % static_cast<uint32_t>(extent)); };
  std::vector<Int3> positions(count);
  for (Int3& p : positions) {
    p = {any(), any(), any()};
    const auto free = static_cast<uint32_t>(random() % 3);
    for (uint32_t axis = 0; voxel > 0 && axis < 3; ++axis) {
      if (axis != free) At(p, axis) = At(p, axis) / voxel * voxel;
    }
  }
  return positions;
}

TEST(PlaneCensus, FindsTheSidesOfVoxels) {
  for (int32_t extent : {4000, 4'000'000}) {
    const auto planes = FindPlanes(Scattered(50000, extent, extent / 100));
    ASSERT_TRUE(planes != nullptr);
    for (uint32_t axis = 0; axis < 3; ++axis) {
      const auto on = planes->On(axis);
      EXPECT_EQ(std::vector<int32_t>(on.begin(), on.end()), Multiples(0, extent / 100, 100));
    }
  }
}

TEST(PlaneCensus, FindsNoneWhereVerticesLieAnywhere) {
  EXPECT_EQ(FindPlanes(Scattered(50000, 4000, 0)), nullptr);
  EXPECT_EQ(FindPlanes(Scattered(50000, 1 << 29, 0)), nullptr);
  EXPECT_EQ(FindPlanes(std::vector<Int3>(1)), nullptr);
}

}  // namespace
}  // namespace folprom
