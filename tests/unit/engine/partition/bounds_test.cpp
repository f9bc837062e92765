#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/partition/partition.h"
#include "test_meshes.h"

namespace folprom::partition {
namespace {

Bounds BoundsWith(const TestMesh& mesh, parallel::Runner& runner) {
  parallel::Progress progress;
  const Bounds bounds = MeasureBounds(TestSource(mesh), runner, progress);
  EXPECT_EQ(progress.done(), mesh.positions.size());
  return bounds;
}

TEST(MeasureBounds, GivesTheBoxForEveryRunner) {
  TestMesh mesh = WavySheet(40, 50);
  mesh.positions[777] = {-3, 12, 99.5};
  const auto serial = parallel::MakeSerialRunner();
  const auto threads = parallel::MakeTbbRunner(3);
  const auto shuffled = parallel::MakeShuffledRunner(1);
  for (parallel::Runner* runner : {serial.get(), threads.get(), shuffled.get()}) {
    const Bounds bounds = BoundsWith(mesh, *runner);
    EXPECT_EQ(bounds.lo[0], -3);
    EXPECT_EQ(bounds.lo[1], 0);
    EXPECT_EQ(bounds.hi[0], 49);
    EXPECT_EQ(bounds.hi[1], 39);
    EXPECT_EQ(bounds.hi[2], 99.5);
    EXPECT_EQ(bounds.longest(), 99.5 - bounds.lo[2]);
  }
}

TEST(MeasureBounds, OfNoVerticesIsEmpty) {
  const auto runner = parallel::MakeSerialRunner();
  EXPECT_TRUE(BoundsWith(TestMesh{}, *runner).empty());
}

TEST(MeasureBounds, ZeroHasNoSign) {
  TestMesh mesh;
  mesh.positions = {{-0.0, 0.0, -0.0}, {0.0, -0.0, -0.0}};
  const auto runner = parallel::MakeSerialRunner();
  const Bounds bounds = BoundsWith(mesh, *runner);
  for (size_t axis = 0; axis < 3; ++axis) {
    EXPECT_FALSE(std::signbit(bounds.lo[axis]));
    EXPECT_FALSE(std::signbit(bounds.hi[axis]));
  }
}

TEST(MeasureBounds, AcceptsTheLargestNumbers) {
  const double largest = std::numeric_limits<double>::max();
  TestMesh mesh;
  mesh.positions = {{largest, -largest, 5e-324}};
  const auto runner = parallel::MakeSerialRunner();
  const Bounds bounds = BoundsWith(mesh, *runner);
  EXPECT_EQ(bounds.lo[0], largest);
  EXPECT_EQ(bounds.lo[1], -largest);
}

TEST(MeasureBounds, NamesTheFirstVertexThatIsNotFinite) {
  const auto runner = parallel::MakeTbbRunner(3);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    TestMesh mesh = WavySheet(40, 50);
    mesh.positions[1234][1] = bad;
    mesh.positions[1700][0] = bad;
    parallel::Progress progress;
    try {
      MeasureBounds(TestSource(mesh), *runner, progress);
      FAIL() << "accepted " << bad;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.error().kind, ErrorKind::kInput);
      EXPECT_EQ(failure.error().message,
                "memory.ply: vertex 1234: coordinate y is not a finite number (--exact keeps it)");
    }
  }
}

TEST(MeasureBounds, StopsWhenCancelled) {
  const auto runner = parallel::MakeSerialRunner();
  parallel::Progress progress;
  progress.Cancel();
  EXPECT_THROW(MeasureBounds(TestSource(WavySheet(9, 9)), *runner, progress), parallel::Cancelled);
}

}  // namespace
}  // namespace folprom::partition
