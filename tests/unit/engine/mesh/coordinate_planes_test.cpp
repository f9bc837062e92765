#include "engine/mesh/coordinate_planes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace folprom {
namespace {

size_t CountBelow(const std::vector<int32_t>& values, int64_t coordinate) {
  return static_cast<size_t>(std::count_if(values.begin(), values.end(),
                                           [&](int32_t value) { return value < coordinate; }));
}

void ExpectCounts(const std::vector<int32_t>& values) {
  const CoordinatePlanes planes(std::array<std::vector<int32_t>, 3>{values, {}, {}});
  std::vector<int64_t> asked{-1, 0, 1, int64_t{1} << 30, (int64_t{1} << 31) + 5};
  for (int32_t value : values) {
    for (int64_t off : {-1, 0, 1}) asked.push_back(value + off);
  }
  for (int64_t coordinate : asked) {
    EXPECT_EQ(planes.Below(0, coordinate), CountBelow(values, coordinate)) << coordinate;
    const bool any = CountBelow(values, coordinate + 7) > CountBelow(values, coordinate);
    EXPECT_EQ(planes.Any(0, coordinate, coordinate + 7), any) << coordinate;
  }
}

TEST(CoordinatePlanes, CountThoseBelow) {
  ExpectCounts({5});
  ExpectCounts({0, 1, 2, 3});
  ExpectCounts({0, (1 << 30) - 1});
  ExpectCounts({1'000'000'000, 1'000'000'001, 1'000'000'900});
  std::mt19937 random(1);
  for (int32_t range : {10, 1000, 1 << 29}) {
    std::set<int32_t> values;
    for (int i = 0; i < 300; ++i) values.insert(static_cast<int32_t>(random()) & (range - 1));
    ExpectCounts({values.begin(), values.end()});
  }
}

TEST(CoordinatePlanes, AreEmptyWithoutAny) {
  EXPECT_TRUE(CoordinatePlanes().empty());
  const CoordinatePlanes planes(std::array<std::vector<int32_t>, 3>{{{}, {3}, {}}});
  EXPECT_FALSE(planes.empty());
  EXPECT_EQ(planes.Below(0, 100), 0u);
  EXPECT_FALSE(planes.Any(2, 0, 100));
}

}  // namespace
}  // namespace folprom
