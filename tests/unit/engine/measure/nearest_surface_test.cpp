// Embree's search finds what looking at every face finds.
#include "engine/measure/nearest_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "engine/measure/triangle_distance.h"
#include "tests/support/random.h"
#include "tests/unit/engine/measure/shapes.h"

namespace folprom::measure {
namespace {

double BruteForce(const TriangleMesh& mesh, const Vector3& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& f : mesh.faces) {
    least = std::min(least, SquaredDistanceToTriangle(point, mesh.positions[f[0]],
                                                      mesh.positions[f[1]], mesh.positions[f[2]]));
  }
  if (mesh.faces.empty()) {
    for (const Vector3& p : mesh.positions) {
      const Vector3 away = Difference(point, p);
      least = std::min(least, Dot(away, away));
    }
  }
  return std::sqrt(least);
}

void ExpectExact(const TriangleMesh& mesh, double spread, uint64_t seed) {
  const parallel::Progress progress;
  const auto runner = parallel::MakeTbbRunner(2);
  const NearestSurface surface(mesh, *runner, progress);
  support::Random random(seed);
  const uint64_t elements = mesh.faces.empty() ? mesh.positions.size() : mesh.faces.size();
  for (int i = 0; i < 2000; ++i) {
    Vector3 point;
    for (double& x : point) x = 0.5 + spread * random.Between(-1, 1);
    const auto guess = static_cast<uint32_t>(random.Below(elements));
    const NearestSurface::Nearest nearest = surface.From(point, guess);
    ASSERT_EQ(nearest.distance, BruteForce(mesh, point));
    ASSERT_EQ(nearest.distance, surface.DistanceOf(nearest.element, point));
  }
}

TEST(NearestSurface, IsExactInsideAndAround) { ExpectExact(RandomTriangles(500, 1), 0.7, 2); }

TEST(NearestSurface, IsExactFarAway) {
  ExpectExact(RandomTriangles(300, 3), 1e3, 4);
  ExpectExact(RandomTriangles(300, 5), 1e9, 6);
}

// Triangles that all look the same to a float.
TEST(NearestSurface, IsExactBelowTheResolutionOfFloats) {
  TriangleMesh mesh = Moved(RandomTriangles(200, 7), {0.5, 0.5, 0.5}, 1e-9);
  ExpectExact(mesh, 1e-9, 8);
  ExpectExact(mesh, 1e-3, 9);
}

TEST(NearestSurface, TakesVerticesWhereThereAreNoFaces) {
  TriangleMesh mesh = RandomTriangles(300, 10);
  mesh.faces.clear();
  ExpectExact(mesh, 0.7, 11);
}

TEST(NearestSurface, BuildingCanBeCancelled) {
  parallel::Progress progress;
  progress.Cancel();
  const TriangleMesh mesh = RandomTriangles(10, 12);
  const auto runner = parallel::MakeSerialRunner();
  EXPECT_THROW(NearestSurface(mesh, *runner, progress), parallel::Cancelled);
}

}  // namespace
}  // namespace folprom::measure
