#include "engine/geometry/local_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace folprom {
namespace {

constexpr int32_t kMost = (1 << 30) - 1;

void ExpectOrthonormal(const LocalFrame& frame) {
  const Vector3 axes[3] = {frame.x, frame.y(), frame.z};
  for (size_t i = 0; i < 3; ++i) {
    for (double value : axes[i]) ASSERT_TRUE(std::isfinite(value));
    for (size_t j = 0; j < 3; ++j) EXPECT_NEAR(Dot(axes[i], axes[j]), i == j ? 1 : 0, 1e-9);
  }
}

void ExpectFinite(const Neighbourhood& at) {
  ExpectOrthonormal(at.frame);
  for (double value : {at.range_rho, at.range_z, at.mean_z, at.min_z}) {
    ASSERT_TRUE(std::isfinite(value));
  }
  EXPECT_GE(at.range_rho, 0);
  EXPECT_GE(at.range_z, 0);
  EXPECT_LE(at.min_z, 0);
}

TEST(MeasureNeighbourhood, FindsThePlaneOfItsPoints) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 200; ++round) {
    Vector3 n{normal(random), normal(random), normal(random)};
    const double length = std::sqrt(Dot(n, n));
    for (double& value : n) value /= length;
    const Vector3 u = Cross(n, std::fabs(n[0]) < 0.7 ? Vector3{1, 0, 0} : Vector3{0, 1, 0});
    const Vector3 v = Cross(n, u);
    const Int3 vertex{500000, 500000, 500000};
    std::vector<Int3> ring;
    for (int i = 0; i < 6; ++i) {
      const double a = i * 1.05 + 0.1 * normal(random), r = 40000;
      auto at = [&](size_t k) {
        return 500000 + static_cast<int32_t>(r * (std::cos(a) * u[k] + std::sin(a) * v[k]));
      };
      ring.push_back({at(0), at(1), at(2)});
    }
    const Neighbourhood found = MeasureNeighbourhood(vertex, ring, 1);
    ExpectFinite(found);
    EXPECT_GT(std::fabs(Dot(found.frame.z, n)), 0.99999);
    EXPECT_LT(found.range_z, 10);
    EXPECT_LT(std::fabs(found.mean_z), 10);
    // u and v are shorter than a unit where n leans towards their axis.
    EXPECT_GT(found.range_rho, 40000 * 0.7);
    EXPECT_LT(found.range_rho, 40001);
  }
}

TEST(MeasureNeighbourhood, MeasuresHeightsOfAHill) {
  const Int3 vertex{1000, 1000, 1300};
  std::vector<Int3> ring;
  for (int i = 0; i < 8; ++i) {
    ring.push_back({1000 + static_cast<int32_t>(900 * std::cos(i * 0.785398)),
                    1000 + static_cast<int32_t>(900 * std::sin(i * 0.785398)), 1000});
  }
  const Neighbourhood found = MeasureNeighbourhood(vertex, ring, 1);
  EXPECT_NEAR(std::fabs(found.frame.z[2]), 1, 1e-3);
  EXPECT_NEAR(found.range_z, 300, 2);
  EXPECT_NEAR(std::fabs(found.mean_z), 300, 2);
  EXPECT_NEAR(found.range_rho, 900, 2);
  EXPECT_EQ(found.frame.origin, vertex);
}

TEST(MeasureNeighbourhood, WithoutNeighboursTakesTheScaleAndTheGlobalAxes) {
  const Neighbourhood found = MeasureNeighbourhood({5, 6, 7}, {}, 123);
  ExpectFinite(found);
  EXPECT_EQ(found.range_rho, 123);
  EXPECT_EQ(found.range_z, 123);
  EXPECT_EQ(found.frame.x, (Vector3{1, 0, 0}));
  EXPECT_EQ(found.frame.z, (Vector3{0, 0, 1}));
}

TEST(MeasureNeighbourhood, OfOneOrTwoNeighboursTakesTheirDistanceAsHeight) {
  const Int3 vertex{1000, 1000, 1000};
  const std::vector<std::vector<Int3>> rings = {{{1000, 1000, 1400}},
                                                {{1300, 1400, 1000}},
                                                {{1000, 1300, 1000}, {1400, 1000, 1000}},
                                                {{1300, 1000, 1000}, {700, 1000, 1000}}};
  for (const auto& ring : rings) {
    const Neighbourhood found = MeasureNeighbourhood(vertex, ring, 1);
    ExpectFinite(found);
    EXPECT_EQ(found.range_z, found.range_rho);
    EXPECT_GT(found.range_rho, 0);
  }
}

TEST(MeasureNeighbourhood, OfCoincidentOrCollinearPointsIsFinite) {
  const std::vector<int32_t> places = {0, 1, 1000, kMost};
  for (int32_t place : places) {
    const Int3 vertex{place, place, place};
    for (size_t count = 1; count < 9; ++count) {
      // All in the vertex itself.
      Neighbourhood found = MeasureNeighbourhood(vertex, std::vector<Int3>(count, vertex), 77);
      ExpectFinite(found);
      EXPECT_EQ(found.range_rho, 77);
      // All in one other point.
      ExpectFinite(MeasureNeighbourhood(vertex, std::vector<Int3>(count, {3, 4, 5}), 77));
      // On a line along an axis, a diagonal, and an odd direction.
      for (const Int3& step : {Int3{1, 0, 0}, Int3{1, 1, 1}, Int3{3, 5, 7}}) {
        std::vector<Int3> line;
        for (int32_t i = 1; i <= static_cast<int32_t>(count); ++i) {
          line.push_back({step.x * i * 1000, step.y * i * 1000, step.z * i * 1000});
        }
        ExpectFinite(MeasureNeighbourhood({0, 0, 0}, line, 77));
      }
    }
  }
}

TEST(MeasureNeighbourhood, OfRandomPointsInTheWholeLatticeIsFinite) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 5000; ++round) {
    const int bits = static_cast<int>(random() % 31);
    auto draw = [&] { return static_cast<int32_t>(random() & ((uint64_t{1} << bits) - 1)); };
    const Int3 vertex{draw(), draw(), draw()};
    std::vector<Int3> ring(random() % 12);
    for (Int3& p : ring) p = {draw(), random() % 3 == 0 ? vertex.y : draw(), draw()};
    ExpectFinite(MeasureNeighbourhood(vertex, ring, 1));
  }
}

}  // namespace
}  // namespace folprom
