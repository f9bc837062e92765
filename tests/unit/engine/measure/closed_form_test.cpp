// Distances that are known in closed form, to 1 % or better.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/engine/measure/shapes.h"

namespace folprom::measure {
namespace {

constexpr double kPart = 0.01;

void ExpectStatistics(const DistanceStatistics& statistics, double mean, double rms, double max) {
  EXPECT_NEAR(statistics.mean, mean, kPart * mean);
  EXPECT_NEAR(statistics.rms, rms, kPart * rms);
  EXPECT_NEAR(statistics.max, max, kPart * max);
}

TEST(ClosedForm, ConcentricSpheresLieApartByTheirRadii) {
  const Comparison c = Compare(Sphere(1, 200), Sphere(1.1, 200));
  ExpectStatistics(c.forward, 0.1, 0.1, 0.1);
  ExpectStatistics(c.backward, 0.1, 0.1, 0.1);
  EXPECT_NEAR(c.diagonal, 2 * std::sqrt(3.0), 1e-3);
}

TEST(ClosedForm, ParallelPlanesLieApartByTheirHeight) {
  const Comparison c = Compare(Plane(0, 0, 7), Plane(0, 0.003, 10));
  for (const DistanceStatistics& s : {c.forward, c.backward}) {
    EXPECT_NEAR(s.mean, 0.003, 1e-12);
    EXPECT_NEAR(s.rms, 0.003, 1e-12);
    EXPECT_NEAR(s.max, 0.003, 1e-12);
  }
  EXPECT_DOUBLE_EQ(c.diagonal, std::sqrt(2.0));
}

// Of a square moved within its plane, what sticks out lies apart.
TEST(ClosedForm, MovedPlaneLiesApartWhereItSticksOut) {
  const double by = 0.25;
  const Comparison c = Compare(Plane(0, 0, 5), Plane(by, 0, 8));
  ExpectStatistics(c.forward, by * by / 2, std::sqrt(by * by * by / 3), by);
  ExpectStatistics(c.backward, by * by / 2, std::sqrt(by * by * by / 3), by);
}

TEST(ClosedForm, CubeHasNoDistanceFromItsSubdivision) {
  const Comparison c = Compare(Cube(1), Cube(9));
  for (const DistanceStatistics& s : {c.forward, c.backward}) {
    EXPECT_EQ(s.mean, 0);
    EXPECT_EQ(s.rms, 0);
    EXPECT_EQ(s.max, 0);
  }
}

TEST(ClosedForm, BumpLiesApartByItsHeight) {
  const double w = 0.2, h = 0.1;
  const double slant = std::sqrt(w * w + h * h);
  const Comparison c = Compare(Plane(0, 0, 20), PlaneWithPyramid(w, h), 400'000);
  // From below the nearest point lies straight across a side of the pyramid.
  const double across = h * w / slant;
  const double base = 4 * w * w;
  ExpectStatistics(c.forward, base * across / 3, std::sqrt(base / 6) * across, across);
  const double sides = 4 * w * slant;
  const double area = sides + 1 - base;
  ExpectStatistics(c.backward, sides * h / 3 / area, h * std::sqrt(sides / 6 / area), h);
}

// The tip of a needle: no sample on the area is likely to meet it.
TEST(ClosedForm, MaximumIncludesVertices) {
  const Comparison c = Compare(Plane(0, 0, 4), PlaneWithPyramid(1e-5, 0.5), 1000);
  EXPECT_NEAR(c.backward.max, 0.5, 1e-12);
}

// Two squares joined by a strip without area: only its edges show that it sags.
TEST(ClosedForm, MaximumIncludesEdges) {
  TriangleMesh wire = Plane(0, 0, 1);
  const auto first = static_cast<uint32_t>(wire.positions.size());
  wire.positions.insert(wire.positions.end(), {{0.5, 0.5, 0}, {2.5, 0.5, 0}});
  wire.faces.push_back({first, first + 1, first});
  TriangleMesh squares = Plane(0, 0, 1);
  for (const auto& face : Plane(0, 0, 1).faces) {
    squares.faces.push_back({face[0] + 4, face[1] + 4, face[2] + 4});
  }
  for (const Vector3& p : Plane(2, 0, 1).positions) squares.positions.push_back(p);
  EXPECT_NEAR(Compare(wire, squares, 10'000).forward.max, 0.5, 0.005);
}

TEST(ClosedForm, FarFromTheOriginAsNearIt) {
  const Vector3 utm = {512'345.25, 5'403'210.5, 310.125};
  const TriangleMesh a = Moved(Plane(0, 0, 7), utm);
  const TriangleMesh b = Moved(Plane(0, 0.003, 10), utm);
  const Comparison c = Compare(a, b);
  // Rounding of the coordinates themselves.
  EXPECT_NEAR(c.forward.mean, 0.003, 1e-9);
  EXPECT_NEAR(c.backward.max, 0.003, 1e-9);
}

TEST(ClosedForm, DistancesScaleWithTheModel) {
  const TriangleMesh a = Sphere(1, 20), b = Sphere(1.05, 31);
  const Comparison c = Compare(a, b, 20'000);
  for (const double factor : {1e-30, 1e-3, 1e6, 1e30}) {
    const Comparison scaled = Compare(Moved(a, {}, factor), Moved(b, {}, factor), 20'000);
    EXPECT_NEAR(scaled.forward.mean / factor, c.forward.mean, 1e-9);
    EXPECT_NEAR(scaled.backward.rms / factor, c.backward.rms, 1e-9);
    EXPECT_NEAR(scaled.backward.max / factor, c.backward.max, 1e-9);
  }
}

}  // namespace
}  // namespace folprom::measure
