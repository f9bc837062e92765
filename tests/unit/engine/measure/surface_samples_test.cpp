#include "engine/measure/surface_samples.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/engine/measure/shapes.h"

namespace folprom::measure {
namespace {

std::vector<Vector3> AreaPoints(const SurfaceSamples& samples) {
  std::vector<Vector3> all, block;
  for (size_t i = 0; i < samples.area_blocks(); ++i) {
    samples.FillAreaBlock(i, &block);
    all.insert(all.end(), block.begin(), block.end());
  }
  return all;
}

std::vector<Vector3> OutlinePoints(const SurfaceSamples& samples) {
  std::vector<Vector3> all, block;
  for (size_t i = 0; i < samples.outline_blocks(); ++i) {
    samples.FillOutlineBlock(i, &block);
    all.insert(all.end(), block.begin(), block.end());
  }
  return all;
}

double MeanOf(const std::vector<Vector3>& points, size_t axis) {
  double sum = 0;
  for (const Vector3& p : points) sum += p[axis];
  return sum / static_cast<double>(points.size());
}

TEST(SurfaceSamples, GivesAsManyPointsAsAsked) {
  const TriangleMesh mesh = Plane(0, 0, 3);
  for (const uint64_t count : {1u, 2u, 17u, 8192u, 8193u, 30'000u}) {
    EXPECT_EQ(AreaPoints(SurfaceSamples(mesh, count)).size(), count);
  }
}

// Two squares, one of them with half the area of the other and many more faces.
TEST(SurfaceSamples, FollowTheAreaNotTheFaces) {
  TriangleMesh mesh = Plane(0, 0, 1);
  const TriangleMesh fine = Moved(Plane(0, 0, 40), {5, 0, 0}, std::sqrt(0.5));
  for (const auto& f : fine.faces) mesh.faces.push_back({f[0] + 4, f[1] + 4, f[2] + 4});
  mesh.positions.insert(mesh.positions.end(), fine.positions.begin(), fine.positions.end());
  const auto points = AreaPoints(SurfaceSamples(mesh, 60'000));
  const auto coarse =
      std::count_if(points.begin(), points.end(), [](const Vector3& p) { return p[0] < 2; });
  EXPECT_NEAR(static_cast<double>(coarse), 40'000, 2);
}

// Fewer points than faces, and a mesh whose faces alternate: no face may be preferred.
TEST(SurfaceSamples, SpreadEvenlyHoweverFew) {
  const TriangleMesh mesh = Plane(0, 0, 200);
  for (const uint64_t count : {20'000u, 40'000u, 80'000u, 400'000u}) {
    const auto points = AreaPoints(SurfaceSamples(mesh, count));
    double x = 0, y = 0;  // within the cell
    for (const Vector3& p : points) {
      x += p[0] * 200 - std::floor(p[0] * 200);
      y += p[1] * 200 - std::floor(p[1] * 200);
    }
    EXPECT_NEAR(x / static_cast<double>(count), 0.5, 0.01);
    EXPECT_NEAR(y / static_cast<double>(count), 0.5, 0.01);
    EXPECT_NEAR(MeanOf(points, 0), 0.5, 0.001);
    EXPECT_NEAR(MeanOf(points, 1), 0.5, 0.001);
  }
}

TEST(SurfaceSamples, OutlineHasEveryVertexOfAFaceAndPointsOfEveryEdge) {
  TriangleMesh mesh = Plane(0, 0, 4);
  const size_t used = mesh.positions.size();
  mesh.positions.push_back({9, 9, 9});  // isolated
  const auto points = OutlinePoints(SurfaceSamples(mesh, 100'000));
  for (size_t v = 0; v < used; ++v) {
    EXPECT_NE(std::find(points.begin(), points.end(), mesh.positions[v]), points.end());
  }
  EXPECT_EQ(std::find(points.begin(), points.end(), mesh.positions[used]), points.end());
  // As dense as on the area: 316 per unit length; edges between faces count once.
  const double length = 2 * 5 + 4 * std::sqrt(2.0);
  EXPECT_NEAR(static_cast<double>(points.size() - used), length * std::sqrt(100'000.0), 60);
}

TEST(SurfaceSamples, OutlineStaysBoundedOnNeedles) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1e-14, 0}};
  mesh.faces = {{0, 1, 2}};
  EXPECT_LE(OutlinePoints(SurfaceSamples(mesh, 5000)).size(), 5010u);
}

TEST(SurfaceSamples, VerticesStandForAreaWhereThereIsNone) {
  TriangleMesh points;
  points.positions = {{0, 0, 0}, {1, 2, 3}, {4, 5, 6}};
  EXPECT_EQ(AreaPoints(SurfaceSamples(points, 1000)), points.positions);
  TriangleMesh segment = points;
  segment.faces = {{0, 2, 0}};
  const std::vector<Vector3> ends = {{0, 0, 0}, {4, 5, 6}};
  EXPECT_EQ(AreaPoints(SurfaceSamples(segment, 1000)), ends);
}

TEST(SurfaceSamples, PointsLieOnTheirMesh) {
  const TriangleMesh mesh = RandomTriangles(300, 1);
  const DistanceStatistics self = Compare(mesh, mesh, 50'000).forward;
  EXPECT_EQ(self.max, 0);
}

}  // namespace
}  // namespace folprom::measure
