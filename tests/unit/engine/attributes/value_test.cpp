#include "engine/attributes/value.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

namespace folprom {
namespace {

using enum ScalarType;

constexpr ScalarType kAllTypes[] = {kInt8,  kUint8,  kInt16,   kUint16,
                                    kInt32, kUint32, kFloat32, kFloat64};

template <class T>
uint64_t Ordered(ScalarType type, T value) {
  uint8_t bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof value);
  return OrderedOf(type, bytes);
}

template <class T>
void ExpectAscending(ScalarType type, const std::vector<T>& values) {
  for (size_t i = 1; i < values.size(); ++i) {
    EXPECT_LT(Ordered(type, values[i - 1]), Ordered(type, values[i])) << values[i];
  }
}

TEST(AttributeValueTest, IsOrderedAsTheNumbersAre) {
  ExpectAscending<int8_t>(kInt8, {-128, -1, 0, 1, 127});
  ExpectAscending<uint8_t>(kUint8, {0, 1, 128, 255});
  ExpectAscending<int16_t>(kInt16, {-32768, -1, 0, 255, 32767});
  ExpectAscending<uint16_t>(kUint16, {0, 255, 256, 65535});
  ExpectAscending<int32_t>(kInt32, {INT32_MIN, -1, 0, 65536, INT32_MAX});
  ExpectAscending<uint32_t>(kUint32, {0, 65536, UINT32_MAX});
  const float big = std::numeric_limits<float>::infinity();
  ExpectAscending<float>(kFloat32, {-big, -3e38f, -1, -1e-45f, -0.0f, 0.0f, 1e-45f, 1, 3e38f, big});
  const double huge = std::numeric_limits<double>::infinity();
  ExpectAscending<double>(kFloat64, {-huge, -1e308, -5e-324, -0.0, 0.0, 5e-324, 1, 1e308, huge});
}

TEST(AttributeValueTest, EveryBitComesBack) {
  std::mt19937_64 random(1);
  for (const ScalarType type : kAllTypes) {
    const size_t size = ScalarSize(type);
    for (int i = 0; i < 3000; ++i) {
      uint8_t bytes[8], back[8];
      const uint64_t bits = i == 0 ? 0 : i == 1 ? ~uint64_t{0} : random();
      std::memcpy(bytes, &bits, 8);
      const uint64_t ordered = OrderedOf(type, bytes);
      ASSERT_LE(ordered, LargestOrdered(type));
      EXPECT_EQ(StoreOrdered(type, ordered, back), back + size);
      EXPECT_EQ(std::memcmp(bytes, back, size), 0);
    }
  }
}

TEST(AttributeValueTest, BoundariesNeverFallAndPartTheValues) {
  std::mt19937_64 random(2);
  for (const ScalarType type : kAllTypes) {
    std::vector<uint64_t> ordered{1, 2, LargestOrdered(type)};
    for (int i = 0; i < 2000; ++i) ordered.push_back(random() % LargestOrdered(type) + 1);
    std::sort(ordered.begin(), ordered.end());
    double before = -1e301;
    for (const uint64_t value : ordered) {
      const double boundary = BoundaryBelow(type, value);
      ASSERT_GE(boundary, before);
      ASSERT_LE(std::abs(boundary), 1e300);
      before = boundary;
    }
  }
  EXPECT_EQ(BoundaryBelow(kUint8, 7), 6.5);
  EXPECT_GT(BoundaryBelow(kFloat32, Ordered(kFloat32, 1.0f)), 0.99999);
  EXPECT_LT(BoundaryBelow(kFloat32, Ordered(kFloat32, 1.0f)), 1);
}

TEST(AttributeValueTest, NearestOfItsRealIsTheValue) {
  for (float value : {-3e38f, -1.5f, 1e-40f, 7.25f}) {
    const uint64_t ordered = Ordered(kFloat32, value);
    EXPECT_EQ(NearestOrdered(kFloat32, RealOf(kFloat32, ordered)), ordered);
  }
  for (const int16_t value : std::array<int16_t, 4>{-32768, -5, 0, 32767}) {
    const uint64_t ordered = Ordered(kInt16, value);
    EXPECT_EQ(NearestOrdered(kInt16, RealOf(kInt16, ordered)), ordered);
  }
  EXPECT_EQ(NearestOrdered(kUint8, 1e300), 255u);
  EXPECT_EQ(NearestOrdered(kUint8, -1e300), 0u);
  EXPECT_EQ(NearestOrdered(kFloat32, 1e300), Ordered(kFloat32, std::numeric_limits<float>::max()));
}

}  // namespace
}  // namespace folprom
