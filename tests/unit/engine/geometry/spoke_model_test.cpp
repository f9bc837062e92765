#include "engine/geometry/spoke_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace folprom {
namespace {

constexpr int32_t kCells = 1 << 12;
const Int3 kOld{2000, 2000, 2000};

RingShape Measured(const std::vector<Int3>& ring) {
  std::vector<RingSpoke> spokes;
  for (const Int3& at : ring) spokes.push_back(SpokeBetween(LanePoint(kOld), LanePoint(at)));
  return MeasureRing(spokes, {}, 1);
}

/// A vertex with six neighbours about 300 away.
RingShape RandomRing(std::mt19937* random) {
  std::vector<Int3> ring;
  for (int i = 0; i < 6; ++i) {
    const auto near = [&] { return static_cast<int32_t>((*random)() % 90) - 45; };
    const double angle = i * 1.0472;
    ring.push_back({kOld.x + static_cast<int32_t>(300 * std::cos(angle)) + near(),
                    kOld.y + static_cast<int32_t>(300 * std::sin(angle)) + near(),
                    kOld.z + near()});
  }
  return Measured(ring);
}

/// What a vertex costs, in bits, where the others hold all cells to be alike: 36 without spokes.
double CostOf(const RingShape& ring, const std::array<int32_t, 3>& vertex, SpokeModel* model) {
  double bits = 0;
  const std::array<int32_t, 3> old{kOld.x, kOld.y, kOld.z};
  model->Start(ring);
  for (uint32_t axis = 0; axis < 3; ++axis) {
    int64_t a = 0, c = kCells;
    model->Begin(axis, 0, a, c, old[axis]);
    while (c - a > 1) {
      const int64_t at = (a + c) / 2;
      const bool above = vertex[axis] >= at;
      const uint32_t probability = model->Weigh(at, 32768);
      EXPECT_GE(probability, 1u);
      EXPECT_LE(probability, 65535u);
      bits -= std::log2((above ? probability : 65536 - probability) / 65536.0);
      model->Learn(above);
      (above ? a : c) = at;
    }
    model->End();
  }
  return bits;
}

std::array<int32_t, 3> OnSpoke(const RingShape& ring, size_t neighbour, double part) {
  const Vector3 d = ring.spokes[neighbour].way();
  return {kOld.x + static_cast<int32_t>(std::lround(d[0] * part)),
          kOld.y + static_cast<int32_t>(std::lround(d[1] * part)),
          kOld.z + static_cast<int32_t>(std::lround(d[2] * part))};
}

TEST(SpokeModel, VerticesOnSpokesSoonCostAThird) {
  std::mt19937 random(1);
  SpokeModel model;
  double bits = 0;
  for (int i = 0; i < 300; ++i) {
    const RingShape ring = RandomRing(&random);
    const double parts[] = {1.0 / 2, 1.0 / 3, 1.0 / 4};
    const double cost = CostOf(ring, OnSpoke(ring, random() % 6, parts[random() % 3]), &model);
    if (i >= 200) bits += cost / 100;
  }
  EXPECT_LT(bits, 12);
}

TEST(SpokeModel, VerticesElsewhereCostWhatTheyDid) {
  std::mt19937 random(2);
  SpokeModel model;
  double bits = 0;
  for (int i = 0; i < 500; ++i) {
    const auto anywhere = [&] { return static_cast<int32_t>(random() % kCells); };
    bits += CostOf(RandomRing(&random), {anywhere(), anywhere(), anywhere()}, &model) / 500;
  }
  EXPECT_LT(bits, 36.1);
}

TEST(SpokeModel, FindsSpokesAfterManyVerticesElsewhere) {
  std::mt19937 random(3);
  SpokeModel model;
  const auto anywhere = [&] { return static_cast<int32_t>(random() % kCells); };
  for (int i = 0; i < 5000; ++i) {
    CostOf(RandomRing(&random), {anywhere(), anywhere(), anywhere()}, &model);
  }
  double bits = 0;
  for (int i = 0; i < 600; ++i) {
    const RingShape ring = RandomRing(&random);
    const double cost = CostOf(ring, OnSpoke(ring, random() % 6, 0.5), &model);
    if (i >= 500) bits += cost / 100;
  }
  EXPECT_LT(bits, 12);
}

TEST(SpokeModel, VerticesBentOffSpokesKeepWhatTheyGainAlongTheSurface) {
  std::mt19937 random(4);
  SpokeModel model;
  double bits = 0;
  for (int i = 0; i < 600; ++i) {
    const RingShape ring = RandomRing(&random);
    std::array<int32_t, 3> vertex = OnSpoke(ring, random() % 6, 0.5);
    vertex[2] = static_cast<int32_t>(random() % kCells);
    const double cost = CostOf(ring, vertex, &model);
    if (i >= 500) bits += cost / 100;
  }
  EXPECT_LT(bits, 12 + 9);
}

TEST(SpokeModel, TakesVerticesWithoutNeighboursAndFarAway) {
  SpokeModel model;
  RingShape none = Measured({});
  EXPECT_NEAR(CostOf(none, {1, 2, 3}, &model), 36, 1e-3);
  std::vector<Int3> ring{{kOld.x + (1 << 29), kOld.y, kOld.z},
                         {kOld.x, kOld.y - (1 << 29), kOld.z}};
  const RingShape far = Measured(ring);
  for (int i = 0; i < 100; ++i) {
    const double cost = CostOf(far, {i, kCells - 1 - i, 0}, &model);
    ASSERT_TRUE(std::isfinite(cost)) << i;
  }
}

}  // namespace
}  // namespace folprom
