#include <gtest/gtest.h>

#include "partition_check.h"

namespace folprom::partition {
namespace {

class PartitionDeterminism : public testing::Test {
 protected:
  static constexpr size_t kBlock = 53;

  static std::vector<uint8_t> Bytes(const TestMesh& mesh, uint64_t memory_bytes,
                                    parallel::Runner& runner, size_t block_size = kBlock) {
    const TestSource source(mesh, block_size);
    PartitionSettings settings;
    settings.subtree_vertices = 150;
    const TestScan result =
        PartitionOf(source, LatticeOf(mesh, 20), settings, memory_bytes, runner);
    return BytesOf(*result.scan);
  }

  static void ExpectSameBytesEverywhere(const TestMesh& mesh) {
    const auto serial = parallel::MakeSerialRunner();
    const std::vector<uint8_t> expected = Bytes(mesh, kTestMemory, *serial);
    for (const int threads : {1, 2, 3, 8}) {
      const auto runner = parallel::MakeTbbRunner(threads);
      EXPECT_EQ(Bytes(mesh, uint64_t{4} << 30, *runner), expected) << threads << " threads";
    }
    for (uint64_t seed = 0; seed < 4; ++seed) {
      const auto runner = parallel::MakeShuffledRunner(seed);
      EXPECT_EQ(Bytes(mesh, uint64_t{4} << 30, *runner), expected) << "seed " << seed;
    }
    const auto runner = parallel::MakeTbbRunner(2);
    for (const uint64_t memory_bytes : {uint64_t{0}, uint64_t{1} << 16, uint64_t{512} << 20}) {
      EXPECT_EQ(Bytes(mesh, memory_bytes, *runner), expected) << memory_bytes << " bytes";
    }
    EXPECT_EQ(Bytes(mesh, kTestMemory, *serial, 4096), expected) << "larger blocks";
  }
};

TEST_F(PartitionDeterminism, ClosedSurface) { ExpectSameBytesEverywhere(Sphere(50, 50)); }
TEST_F(PartitionDeterminism, ShuffledSheet) {
  ExpectSameBytesEverywhere(Shuffled(WavySheet(50, 50), 9));
}
TEST_F(PartitionDeterminism, DenseSpot) { ExpectSameBytesEverywhere(DenseSpot(3000)); }
TEST_F(PartitionDeterminism, CoincidentVertices) { ExpectSameBytesEverywhere(Coincident(2000)); }
TEST_F(PartitionDeterminism, Soup) { ExpectSameBytesEverywhere(Soup(1500, 4000)); }

// The cuts come from places and faces, not from the order in which the file gives them.
TEST_F(PartitionDeterminism, CutsDoNotDependOnTheOrderOfTheFile) {
  PartitionSettings settings;
  settings.subtree_vertices = 200;
  const TestMesh mesh = WavySheet(45, 55);
  const Lattice lattice = LatticeOf(mesh, 18);
  const TestScan plain = PartitionOf(TestSource(mesh), lattice, settings);
  const TestScan shuffled = PartitionOf(TestSource(Shuffled(mesh, 4)), lattice, settings);
  ASSERT_EQ(plain.scan->subtree_count(), shuffled.scan->subtree_count());
  for (size_t i = 0; i < plain.scan->subtree_count(); ++i) {
    const SubtreeSummary &a = plain.scan->summary(i), &b = shuffled.scan->summary(i);
    EXPECT_EQ(a.vertices, b.vertices);
    EXPECT_EQ(a.faces, b.faces);
    EXPECT_EQ(a.cross_faces, b.cross_faces);
    EXPECT_EQ(a.box_lo, b.box_lo);
    EXPECT_EQ(a.box_hi, b.box_hi);
    EXPECT_EQ(a.neighbours, b.neighbours);
  }
}

}  // namespace
}  // namespace folprom::partition
