#include "engine/geometry/light_position_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

using Cells = std::array<int32_t, 3>;
constexpr int32_t kMost = 4095;
const Int3 kOld{2000, 2000, 2000};

/// A vertex with six neighbours about 300 away.
std::vector<RingSpoke> RandomRing(std::mt19937* random) {
  std::vector<RingSpoke> spokes;
  for (int i = 0; i < 6; ++i) {
    const auto near = [&] { return static_cast<int32_t>((*random)() % 90) - 45; };
    const double angle = i * 1.0472;
    const Int3 at{kOld.x + static_cast<int32_t>(300 * std::cos(angle)) + near(),
                  kOld.y + static_cast<int32_t>(300 * std::sin(angle)) + near(), kOld.z + near()};
    spokes.push_back(SpokeBetween(LanePoint(kOld), LanePoint(at)));
  }
  return spokes;
}

struct Split {
  std::vector<RingSpoke> spokes;
  Cells cells;
};

/// Mean bits of the last 200 vertices. All must come back.
double CostOf(const std::vector<Split>& splits, std::shared_ptr<const CoordinatePlanes> planes) {
  LightPositionModel writer({0, 0, 0}, {kMost, kMost, kMost}), reader = writer;
  writer.UsePlanes(planes);
  reader.UsePlanes(planes);
  BitEncoder encoder;
  uint64_t before = 0, cost = 0;
  for (size_t i = 0; i < splits.size(); ++i) {
    uint64_t* meter = i + 200 < splits.size() ? &before : &cost;
    const Cells coded = writer.Code(encoder, kOld, MeasureLightRing(splits[i].spokes, {}, 1),
                                    {0, 0, 0}, splits[i].cells, meter, meter);
    EXPECT_EQ(coded, splits[i].cells) << i;
  }
  const std::vector<uint8_t> bytes = encoder.TakeSegment();
  BitDecoder decoder;
  decoder.StartSegment(bytes);
  for (size_t i = 0; i < splits.size(); ++i) {
    EXPECT_EQ(reader.Code(decoder, kOld, MeasureLightRing(splits[i].spokes, {}, 1), {0, 0, 0}, {},
                          nullptr, nullptr),
              splits[i].cells)
        << i;
  }
  decoder.FinishSegment();
  return static_cast<double>(cost) / 1024 / 200;
}

std::vector<Split> Somewhere(uint32_t seed, int32_t step) {
  std::mt19937 random(seed);
  std::vector<Split> splits;
  for (int i = 0; i < 3000; ++i) {
    const auto near = [&] {
      return (kOld.x + static_cast<int32_t>(random() % 400) - 200) / step * step;
    };
    Split split{RandomRing(&random), {near(), near(), near()}};
    splits.push_back(split);
  }
  return splits;
}

TEST(LightPositionModel, VerticesNearTheOldOneCostTheirSpread) {
  // Even over 400 cells on each axis: 25.9 bits.
  EXPECT_LT(CostOf(Somewhere(1, 1), nullptr), 28);
}

TEST(LightPositionModel, VerticesOnPlanesCostWhichPlane) {
  std::vector<int32_t> every;
  for (int32_t at = 0; at <= kMost; at += 20) every.push_back(at);
  auto planes =
      std::make_shared<CoordinatePlanes>(std::array<std::vector<int32_t>, 3>{every, every, every});
  // Even over 20 planes on each axis: 13 bits.
  EXPECT_LT(CostOf(Somewhere(2, 20), planes), 15.5);
  EXPECT_LT(CostOf(Somewhere(3, 1), planes), 29);
}

TEST(LightPositionModel, VerticesInTheMiddleOfSpokesCostWhichSpoke) {
  std::mt19937 random(4);
  std::vector<Split> splits;
  for (int i = 0; i < 3000; ++i) {
    const std::vector<RingSpoke> ring = RandomRing(&random);
    const Vector3 way = ring[random() % 6].way();
    splits.push_back({ring,
                      {kOld.x + static_cast<int32_t>(std::lround(way[0] / 2)),
                       kOld.y + static_cast<int32_t>(std::lround(way[1] / 2)),
                       kOld.z + static_cast<int32_t>(std::lround(way[2] / 2))}});
  }
  EXPECT_LT(CostOf(splits, nullptr), 6);
}

TEST(LightPositionModel, PlanesInAllCellsButOneLeaveThatOne) {
  std::vector<int32_t> all_but_one;
  for (int32_t at = 0; at <= kMost; ++at) {
    if (at != 2001) all_but_one.push_back(at);
  }
  auto planes = std::make_shared<CoordinatePlanes>(
      std::array<std::vector<int32_t>, 3>{all_but_one, all_but_one, all_but_one});
  CostOf(Somewhere(5, 1), planes);
  std::mt19937 random(6);
  CostOf(std::vector<Split>(300, {RandomRing(&random), {2001, 2001, 2001}}), planes);
}

}  // namespace
}  // namespace folprom
