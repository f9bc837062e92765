#include "engine/measure/triangle_distance.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"
#include "tests/unit/engine/measure/shapes.h"

namespace folprom::measure {
namespace {

constexpr Vector3 kA = {0, 0, 0}, kB = {4, 0, 0}, kC = {0, 3, 0};

TEST(TriangleDistance, AboveInteriorEdgesAndCorners) {
  EXPECT_DOUBLE_EQ(SquaredDistanceToTriangle({1, 1, 2}, kA, kB, kC), 4);
  EXPECT_DOUBLE_EQ(SquaredDistanceToTriangle({1, 1, 0}, kA, kB, kC), 0);
  EXPECT_DOUBLE_EQ(SquaredDistanceToTriangle({2, -3, 4}, kA, kB, kC), 25);
  EXPECT_DOUBLE_EQ(SquaredDistanceToTriangle({-2, 1, 0}, kA, kB, kC), 4);
  EXPECT_DOUBLE_EQ(SquaredDistanceToTriangle({-1, -2, 2}, kA, kB, kC), 9);
  EXPECT_DOUBLE_EQ(SquaredDistanceToTriangle({6, -1, 2}, kA, kB, kC), 9);
  EXPECT_DOUBLE_EQ(SquaredDistanceToTriangle({-1, 5, 2}, kA, kB, kC), 9);
  EXPECT_NEAR(SquaredDistanceToTriangle({2 + 3, 1.5 + 4, 0}, kA, kB, kC), 25, 1e-12);
}

TEST(TriangleDistance, WithoutAreaItIsTheSegmentOrThePoint) {
  EXPECT_DOUBLE_EQ(SquaredDistanceToTriangle({2, 3, 4}, kA, kB, kA), 25);
  EXPECT_DOUBLE_EQ(SquaredDistanceToTriangle({2, 3, 4}, kA, {1, 0, 0}, kB), 25);
  EXPECT_DOUBLE_EQ(SquaredDistanceToTriangle({2, 3, 6}, kA, kA, kA), 49);
}

TEST(TriangleDistance, DoesNotDependOnTheOrderOfCorners) {
  const TriangleMesh mesh = RandomTriangles(2000, 1);
  support::Random random(2);
  for (const auto& f : mesh.faces) {
    const Vector3 &a = mesh.positions[f[0]], &b = mesh.positions[f[1]], &c = mesh.positions[f[2]];
    const Vector3 p = {random.Between(-1, 2), random.Between(-1, 2), random.Between(-1, 2)};
    const double squared = SquaredDistanceToTriangle(p, a, b, c);
    EXPECT_NEAR(SquaredDistanceToTriangle(p, b, c, a), squared, 1e-13);
    EXPECT_NEAR(SquaredDistanceToTriangle(p, c, b, a), squared, 1e-13);
  }
}

// No point of the triangle lies nearer, and some point lies as near.
TEST(TriangleDistance, IsTheLeastOverThePointsOfTheTriangle) {
  const TriangleMesh mesh = RandomTriangles(200, 3);
  support::Random random(4);
  for (const auto& f : mesh.faces) {
    const Vector3& a = mesh.positions[f[0]];
    const Vector3 ab = Difference(mesh.positions[f[1]], a);
    const Vector3 ac = Difference(mesh.positions[f[2]], a);
    const Vector3 p = {random.Between(-1, 2), random.Between(-1, 2), random.Between(-1, 2)};
    const double distance =
        std::sqrt(SquaredDistanceToTriangle(p, a, mesh.positions[f[1]], mesh.positions[f[2]]));
    constexpr int kSteps = 60;
    double least = 1e9;
    for (int i = 0; i <= kSteps; ++i) {
      for (int k = 0; k + i <= kSteps; ++k) {
        const Vector3 q = Combination(a, double{1} * i / kSteps, ab, double{1} * k / kSteps, ac);
        least = std::min(least, Length(Difference(p, q)));
      }
    }
    EXPECT_LE(distance, least + 1e-12);
    EXPECT_GE(distance, least - (Length(ab) + Length(ac)) / kSteps);
  }
}

}  // namespace
}  // namespace folprom::measure
