// Whole comparisons: runners, files, hostile meshes.
#include "engine/measure/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "folprom/folprom.h"
#include "tests/support/files.h"
#include "tests/support/meshes.h"
#include "tests/support/ply.h"
#include "tests/support/surfaces.h"
#include "tests/unit/engine/measure/shapes.h"

namespace folprom::measure {
namespace {

void ExpectSame(const DistanceStatistics& a, const DistanceStatistics& b) {
  EXPECT_EQ(a.mean, b.mean);
  EXPECT_EQ(a.rms, b.rms);
  EXPECT_EQ(a.max, b.max);
}

void ExpectFinite(const Comparison& c) {
  for (const DistanceStatistics& s : {c.forward, c.backward}) {
    EXPECT_TRUE(std::isfinite(s.mean) && std::isfinite(s.rms) && std::isfinite(s.max));
    EXPECT_GE(s.mean, 0);
    EXPECT_LE(s.mean, s.rms * (1 + 1e-12));
    EXPECT_LE(s.rms, s.max * (1 + 1e-12));
  }
}

class CompareFile : public testing::Test {
 protected:
  Result<Comparison> Run(const std::string& a, const std::string& b) {
    const auto runner = parallel::MakeTbbRunner(2);
    CompareOptions options;
    options.samples = 2000;
    options.temporary_folder = folder_.path();
    return CompareFiles(a, b, options, *runner, progress_);
  }
  std::string Written(const std::string& name, const support::Mesh& mesh) {
    support::WritePly(folder_.File(name), mesh, support::CoordinateType::kDouble);
    return folder_.File(name);
  }
  void ExpectInputError(const std::string& a, const std::string& b, const std::string& part) {
    const auto result = Run(a, b);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().kind, ErrorKind::kInput);
    EXPECT_NE(result.error().message.find(part), std::string::npos) << result.error().message;
  }

  support::TemporaryFolder folder_;
  parallel::Progress progress_;
};

TEST(Compare, GivesTheSameForEveryRunner) {
  const TriangleMesh a = Sphere(1, 60), b = Moved(RandomTriangles(1000, 1), {-0.5, -0.5, -0.5});
  const Comparison serial = Compare(a, b, 20'000);
  const auto expect_same = [&](std::unique_ptr<parallel::Runner> runner) {
    const Comparison other = Compare(a, b, 20'000, runner.get());
    ExpectSame(other.forward, serial.forward);
    ExpectSame(other.backward, serial.backward);
  };
  for (const int threads : {1, 2, 3, 8}) expect_same(parallel::MakeTbbRunner(threads));
  for (const uint64_t seed : {1u, 2u}) expect_same(parallel::MakeShuffledRunner(seed));
}

TEST(Compare, MoreSamplesAgreeWithFewer) {
  const TriangleMesh a = Sphere(1, 50), b = Moved(Cube(20), {-0.6, -0.6, -0.6}, 1.2);
  const Comparison few = Compare(a, b, 20'000), many = Compare(a, b, 500'000);
  EXPECT_NEAR(few.forward.mean, many.forward.mean, 0.003 * many.forward.mean);
  EXPECT_NEAR(few.backward.rms, many.backward.rms, 0.003 * many.backward.rms);
  EXPECT_NEAR(few.backward.max, many.backward.max, 0.01 * many.backward.max);
}

TEST(Compare, OneOriginalServesManyMeshes) {
  const auto runner = parallel::MakeSerialRunner();
  parallel::Progress progress;
  Original original(Sphere(1, 40), "a.ply", *runner, progress);
  for (const double radius : {1.1, 0.9, 1.1}) {
    const TriangleMesh other = Sphere(radius, 30);
    const Comparison fresh = Compare(Sphere(1, 40), other, 10'000);
    const Comparison again = original.Against(other, "b.ply", 10'000);
    ExpectSame(again.forward, fresh.forward);
    ExpectSame(again.backward, fresh.backward);
  }
}

TEST(Compare, DegenerateFacesGiveNumbers) {
  TriangleMesh flat = Plane(0, 0, 3);
  flat.faces.push_back({0, 0, 0});
  flat.faces.push_back({0, 1, 1});
  flat.faces.push_back({0, 1, 2});  // collinear
  ExpectFinite(Compare(flat, RandomTriangles(50, 1), 5000));
  TriangleMesh point;
  point.positions = {{0.5, 0.5, 2}};
  point.faces = {{0, 0, 0}};
  const Comparison to_point = Compare(flat, point, 5000);
  ExpectFinite(to_point);
  EXPECT_DOUBLE_EQ(to_point.backward.max, 2);
  const Comparison from_point = Compare(point, flat, 5000);
  ExpectFinite(from_point);
  EXPECT_EQ(from_point.diagonal, 0);
  EXPECT_DOUBLE_EQ(from_point.forward.mean, 2);
}

// Isolated vertices belong to the box, not to the surface.
TEST(Compare, SurfaceIsTheFaces) {
  TriangleMesh with_isolated = Plane(0, 0.25, 3);
  with_isolated.positions.push_back({0.5, 0.5, 9});
  const Comparison c = Compare(Plane(0, 0, 3), with_isolated, 5000);
  EXPECT_NEAR(c.forward.max, 0.25, 1e-12);
  EXPECT_NEAR(c.backward.max, 0.25, 1e-12);
}

TEST(Compare, VerticesAreTheSurfaceWhereThereIsNoFace) {
  TriangleMesh points = Plane(0, 0.25, 2);
  points.faces.clear();
  const Comparison c = Compare(points, Plane(0, 0, 3), 5000);
  EXPECT_NEAR(c.forward.mean, 0.25, 1e-12);
  // The point farthest from the nine is the middle of four.
  EXPECT_NEAR(c.backward.max, std::sqrt(0.25 * 0.25 * 3), 0.01);
}

TEST(Compare, DefaultSamplesFollowTheFaces) {
  EXPECT_EQ(DefaultSamples(0), 500'000u);
  EXPECT_EQ(DefaultSamples(100'000), 1'000'000u);
  EXPECT_EQ(DefaultSamples(uint64_t{1} << 60), 10'000'000u);
}

TEST_F(CompareFile, DecodesFolpFiles) {
  const std::string scan = Written("a.ply", support::BumpySphere(3000, false, 1));
  const auto runner = parallel::MakeSerialRunner();
  EncodeOptions options;
  options.temporary_folder = folder_.path();
  EncodeFile(scan, folder_.File("a.folp"), options, *runner, progress_).value();
  const double tolerance = ReadInfo(folder_.File("a.folp")).value().tolerance.value();
  const Comparison c = Run(scan, folder_.File("a.folp")).value();
  EXPECT_GT(c.forward.mean, 0);
  EXPECT_LE(c.forward.max, tolerance * std::sqrt(3.0));
  EXPECT_LE(c.backward.max, tolerance * std::sqrt(3.0));
  ExpectSame(c.forward, Run(scan, folder_.File("a.folp")).value().forward);
  const std::vector<std::string> left = {"a.folp", "a.ply"};
  EXPECT_EQ(folder_.Names(), left);
}

TEST_F(CompareFile, ReadsEverySmallMesh) {
  const std::string plane = Written("plane.ply", support::FlatGrid(4, 4));
  for (const support::SmallMesh& small : support::SmallMeshes()) {
    const support::Mesh mesh = small.make();
    if (mesh.positions.empty()) continue;
    const std::string file = Written(small.name + ".ply", mesh);
    auto c = Run(file, plane);
    ASSERT_TRUE(c.ok()) << small.name << ": " << c.error().message;
    ExpectFinite(*c);
    const auto self = Run(file, file);
    ASSERT_TRUE(self.ok()) << small.name << ": " << self.error().message;
  }
}

TEST_F(CompareFile, RefusesMeshesWithoutAPlace) {
  const std::string plane = Written("plane.ply", support::FlatGrid(3, 3));
  ExpectInputError(plane, Written("empty.ply", {}), "empty.ply: the mesh has no vertices");
  ExpectInputError(Written("empty.ply", {}), plane, "empty.ply: the mesh has no vertices");
  support::Mesh bad = support::FlatGrid(3, 3);
  bad.positions[7][1] = std::numeric_limits<double>::quiet_NaN();
  ExpectInputError(plane, Written("nan.ply", bad), "nan.ply: vertex 7");
  bad.positions[7][1] = std::numeric_limits<double>::infinity();
  ExpectInputError(Written("inf.ply", bad), plane, "inf.ply: vertex 7");
  bad.positions[7][1] = std::numeric_limits<double>::max();
  bad.positions[6][1] = -std::numeric_limits<double>::max();
  ExpectInputError(Written("huge.ply", bad), plane, "huge.ply: the bounding box");
  ExpectInputError(plane, Written("far.ply", bad), "far.ply: lies too far away");
  ExpectInputError(plane, folder_.File("none.ply"), "none.ply");
}

TEST_F(CompareFile, CanBeCancelled) {
  const std::string plane = Written("plane.ply", support::FlatGrid(3, 3));
  progress_.Cancel();
  EXPECT_EQ(Run(plane, plane).error().kind, ErrorKind::kInterrupted);
}

}  // namespace
}  // namespace folprom::measure
