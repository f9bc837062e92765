#include "engine/geometry/light_ring.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace folprom {
namespace {

const Int3 kVertex{1 << 20, 1 << 20, 1 << 20};

std::vector<RingSpoke> SpokesTo(const std::vector<Int3>& offsets) {
  std::vector<RingSpoke> spokes;
  for (const Int3& d : offsets) {
    const Int3 neighbour{kVertex.x + d.x, kVertex.y + d.y, kVertex.z + d.z};
    spokes.push_back(SpokeBetween(LanePoint(kVertex), LanePoint(neighbour)));
  }
  return spokes;
}

/// The sum over the faces of a closed fan.
Vector3 NormalOf(const std::vector<RingSpoke>& spokes) {
  Vector3 normal{0, 0, 0};
  for (size_t i = 0; i < spokes.size(); ++i) {
    const Vector3 face = Cross(spokes[i].way(), spokes[(i + 1) % spokes.size()].way());
    for (size_t k = 0; k < 3; ++k) normal[k] = normal[k] + face[k];
  }
  return normal;
}

std::vector<Int3> RandomOffsets(std::mt19937* random, size_t count) {
  std::vector<Int3> offsets;
  const auto near = [&] { return static_cast<int32_t>((*random)() % 61) - 30; };
  for (size_t i = 0; i < count; ++i) {
    const double angle = 6.2831853 * static_cast<double>(i) / static_cast<double>(count);
    offsets.push_back({near() / 2, static_cast<int32_t>(100 * std::cos(angle)) + near(),
                       static_cast<int32_t>(100 * std::sin(angle)) + near()});
  }
  return offsets;
}

void ExpectFinite(const LightRing& ring) {
  std::vector<double> values{ring.spacing, ring.covariance, ring.miss, ring.range};
  for (const Vector3* v : {&ring.mean, &ring.direction, &ring.bend}) {
    values.insert(values.end(), v->begin(), v->end());
  }
  for (const auto* v : {&ring.variance, &ring.slope}) {
    values.insert(values.end(), v->begin(), v->end());
  }
  for (double at : {-1e9, 0.0, 1e9}) values.push_back(ring.Across(at, -at));
  for (size_t i = 0; i < values.size(); ++i) EXPECT_TRUE(std::isfinite(values[i])) << i;
  EXPECT_GT(ring.spacing, 0);
}

TEST(LightRing, SeesWhatTheRingShapeSees) {
  std::mt19937 random(11);
  for (size_t count = 3; count < 12; ++count) {
    const auto spokes = SpokesTo(RandomOffsets(&random, count));
    FanSums fan;
    for (size_t i = 0; i < count; ++i) {
      const RingSpoke &a = spokes[i], &b = spokes[(i + 1) % count];
      fan.AddFace({a.xy, b.xy, Pair{a.z_length[0], b.z_length[0]}});
    }
    const RingShape shape = MeasureRing(spokes, fan, 1);
    const LightRing ring = MeasureLightRing(spokes, fan.normal(), 1);
    ExpectFinite(ring);
    EXPECT_EQ(ring.count, shape.count);
    EXPECT_EQ(ring.axes, (std::array{1u, 2u, 0u}));
    EXPECT_EQ(shape.dominant, 0u);
    EXPECT_NEAR(ring.spacing, shape.spacing, 1e-9);
    for (size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(ring.mean[i], shape.mean[i], 1e-9);
      EXPECT_NEAR(ring.direction[i], shape.direction[i], 1e-9);
    }
    EXPECT_NEAR(ring.variance[0], shape.covariance[3], 1e-6);
    EXPECT_NEAR(ring.variance[1], shape.covariance[5], 1e-6);
    EXPECT_NEAR(ring.covariance, shape.covariance[4], 1e-6);
    EXPECT_NEAR(ring.range, shape.height_range / std::fabs(shape.normal[0]), 1e-6);
  }
}

TEST(LightRing, TiltedRingIsMetInItsPlane) {
  const auto spokes = SpokesTo({{100, 0, 50}, {0, 100, -20}, {-100, 0, -50}, {0, -100, 20}});
  const LightRing ring = MeasureLightRing(spokes, NormalOf(spokes), 1);
  EXPECT_EQ(ring.axes, (std::array{0u, 1u, 2u}));
  EXPECT_NEAR(ring.Across(40, 10), 40 * 0.5 - 10 * 0.2, 1e-9);
  EXPECT_NEAR(ring.miss, 0, 1e-6);
  EXPECT_NEAR(ring.range, 0, 1e-9);
}

TEST(LightRing, ParaboloidIsMetClosely) {
  std::vector<Int3> offsets;
  for (int i = 0; i < 8; ++i) {
    const double radius = i % 2 == 0 ? 1000 : 1400, angle = i * 0.7853982;
    const double x = radius * std::cos(angle), y = radius * std::sin(angle);
    offsets.push_back({static_cast<int32_t>(x), static_cast<int32_t>(y),
                       static_cast<int32_t>(2e-4 * x * x - 1e-4 * x * y + 1e-4 * y * y)});
  }
  const auto spokes = SpokesTo(offsets);
  const LightRing ring = MeasureLightRing(spokes, NormalOf(spokes), 1);
  EXPECT_NEAR(ring.Across(500, 500), 2e-4 * 25e4, 10);
  EXPECT_LT(ring.miss, 20);
  EXPECT_GT(ring.range, 150);
}

TEST(LightRing, WithoutNeighboursTheScaleStands) {
  const LightRing ring = MeasureLightRing({}, {0, 0, 0}, 60);
  ExpectFinite(ring);
  EXPECT_EQ(ring.count, 0u);
  EXPECT_EQ(ring.spacing, 60);
  EXPECT_EQ(ring.Across(10, 10), 0);
  EXPECT_EQ(MeasureLightRing({}, {0, 0, 0}, 0).spacing, 1);
}

TEST(LightRing, CoincidentAndCollinearNeighboursStayFinite) {
  const std::vector<std::vector<Int3>> rings{
      {{0, 0, 0}},
      {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}},
      {{5, 0, 0}, {-5, 0, 0}},
      {{0, 0, 7}, {0, 0, 9}, {0, 0, -7}},
      {{2000000, 2000000, 2000000}, {-900000, -900000, -900000}, {1, 1, 1}}};
  for (const auto& offsets : rings) {
    const auto spokes = SpokesTo(offsets);
    ExpectFinite(MeasureLightRing(spokes, NormalOf(spokes), 0));
  }
}

TEST(LightRing, LooksAtTheFirstOfVeryManyNeighbours) {
  std::mt19937 random(12);
  const auto spokes = SpokesTo(RandomOffsets(&random, 1000));
  const LightRing ring = MeasureLightRing(spokes, NormalOf(spokes), 1);
  ExpectFinite(ring);
  EXPECT_EQ(ring.count, 1000u);
  EXPECT_EQ(ring.spokes.size(), RingShape::kMostSpokes);
}

}  // namespace
}  // namespace folprom
