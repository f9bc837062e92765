#include "engine/geometry/tangent_density.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "engine/entropy/fixed_math.h"

namespace folprom {
namespace {

FanFace FaceOf(const RingSpoke& a, const RingSpoke& b) {
  return {a.xy, b.xy, Pair{a.z_length[0], b.z_length[0]}};
}

RingShape Hexagon(double spacing) {
  const Int3 vertex{1 << 28, 1 << 28, 1 << 28};
  std::vector<RingSpoke> ring;
  FanSums fan;
  for (int i = 0; i < 6; ++i) {
    const Int3 neighbour{vertex.x + static_cast<int32_t>(spacing * std::cos(i * kPi / 3)),
                         vertex.y + static_cast<int32_t>(spacing * std::sin(i * kPi / 3)),
                         vertex.z};
    ring.push_back(SpokeBetween(LanePoint(vertex), LanePoint(neighbour)));
  }
  for (size_t i = 0; i < 6; ++i) {
    fan.AddFace(FaceOf(ring[i], ring[(i + 1) % 6]));
  }
  return MeasureRing(ring, fan, 1);
}

void ExpectSound(const AxisDensity& density, double around) {
  double before = 0;
  for (int i = -20; i <= 20; ++i) {
    const double now = density.Below(around * i / 5);
    ASSERT_TRUE(std::isfinite(now) && now >= before && now <= 1) << i << ": " << now;
    before = now;
  }
}

/// By the step of the grid.
using TangentDensityTest = ::testing::TestWithParam<uint32_t>;
INSTANTIATE_TEST_SUITE_P(Step, TangentDensityTest, ::testing::Values(1u, 2u, 3u, 4u));

TEST_P(TangentDensityTest, LearnsWhereNewVerticesLie) {
  const RingShape ring = Hexagon(1000);
  TangentDensity model(GetParam());
  AxisDensity x, y;
  const Vector3 ahead{500, 0, 0};
  for (int i = 0; i < 300; ++i) {
    model.Prepare(ring, ahead);
    model.First(0, &x);
    model.Second(1, 0, 400 + i % 3, &y);
    model.Learn(200 - i % 5);
  }
  model.Prepare(ring, ahead);
  model.First(0, &x);
  EXPECT_GT(x.Below(550) - x.Below(250), 0.6);
  model.Second(1, 0, 400, &y);
  // To which side it lies is not learned.
  EXPECT_GT(y.Below(350) - y.Below(50) + y.Below(-50) - y.Below(-350), 0.7);
}

TEST_P(TangentDensityTest, StaysFiniteOverThousandsOfExtremeSamples) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> part(-1, 1);
  TangentDensity model(GetParam());
  AxisDensity first, second;
  for (int round = 0; round < 5000; ++round) {
    const double size = std::exp2(static_cast<double>(random() % 30));
    const Int3 vertex{1 << 29, 1 << 29, 1 << 29};
    std::vector<RingSpoke> neighbours;
    for (uint64_t i = random() % 40; i > 0; --i) {
      auto at = [&] {
        return (1 << 29) + (round % 7 == 0 ? 0 : static_cast<int32_t>(size / 2 * part(random)));
      };
      const Int3 neighbour{at(), at(), at()};
      neighbours.push_back(SpokeBetween(LanePoint(vertex), LanePoint(neighbour)));
    }
    const RingShape ring = MeasureRing(neighbours, {}, 1);
    const double far = std::exp2(static_cast<double>(random() % 64));
    const Vector3 ahead{far * part(random), far * part(random), round % 11 == 0 ? 0 : far};
    model.Prepare(ring, round % 13 == 0 ? Vector3{0, 0, 0} : ahead);
    const uint32_t axis = (ring.dominant + 1) % 3, other = (ring.dominant + 2) % 3;
    model.First(axis, &first);
    const double offset = round % 5 == 0 ? 0 : size * part(random);
    model.Second(other, axis, offset, &second);
    ExpectSound(first, ring.spacing);
    ExpectSound(second, ring.spacing);
    if (HasFatalFailure()) FAIL() << "round " << round;
    model.Learn(round % 3 == 0 ? offset : size * part(random));
  }
}

TEST_P(TangentDensityTest, SurvivesTheSameExtremeSampleOverAndOver) {
  const RingShape ring = Hexagon(1000);
  TangentDensity model(GetParam());
  AxisDensity first, second;
  for (int i = 0; i < 20000; ++i) {
    model.Prepare(ring, {700, 0, 0});
    model.Second(1, 0, 1400, &second);
    model.Learn(500);
  }
  model.Prepare(ring, {700, 0, 0});
  model.First(0, &first);
  model.Second(1, 0, 1400, &second);
  ExpectSound(first, 1000);
  ExpectSound(second, 1000);
}

}  // namespace
}  // namespace folprom
