#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "partition_check.h"

namespace folprom::partition {
namespace {

// Subtrees beyond the fewest that could hold all vertices.
double Surplus(const TestScan& result, uint32_t subtree_vertices) {
  const auto vertices = static_cast<double>(result.scan->vertex_map().size());
  return static_cast<double>(result.scan->subtree_count()) / std::ceil(vertices / subtree_vertices);
}

TEST(PartitionCoverage, ASmallScanIsOneSubtree) {
  const TestScan result = CheckedPartitionOf(TestSource(WavySheet(20, 30)), 12, 600);
  EXPECT_EQ(result.scan->subtree_count(), 1u);
}

TEST(PartitionCoverage, AScanWithoutVerticesHasNoSubtrees) {
  const TestScan result = CheckedPartitionOf(TestSource(TestMesh{}), 12, 100);
  EXPECT_EQ(result.scan->subtree_count(), 0u);
  EXPECT_TRUE(result.scan->vertex_map().empty());
}

TEST(PartitionCoverage, ASurfaceFallsIntoFewWellFilledSubtrees) {
  const TestScan result = CheckedPartitionOf(TestSource(WavySheet(120, 150)), 17, 1000);
  EXPECT_LE(Surplus(result, 1000), 1.25);
}

TEST(PartitionCoverage, ThePeakOfTheSpillHoldsWhatWasRemovedSince) {
  const TestScan result = CheckedPartitionOf(TestSource(WavySheet(40, 50)), 17, 500);
  // At least a number per vertex tells where it lies.
  EXPECT_GE(result.scan->peak_spill_bytes(), result.spill->SizeBytes() + 2000 * sizeof(uint32_t));
}

TEST(PartitionCoverage, AClosedSurfaceIsComplete) {
  const TestScan result = CheckedPartitionOf(TestSource(Sphere(100, 100)), 17, 700);
  EXPECT_LE(Surplus(result, 700), 1.25);
}

TEST(PartitionCoverage, TheOrderOfTheFileDoesNotMatterToCompleteness) {
  CheckedPartitionOf(TestSource(Shuffled(WavySheet(60, 70), 3)), 17, 300);
}

TEST(PartitionCoverage, CoincidentVerticesAreCutInTheOrderOfTheFile) {
  const TestScan result = CheckedPartitionOf(TestSource(Coincident(10000)), 12, 100);
  const auto refs = result.scan->vertex_map();
  for (size_t i = 1; i < refs.size(); ++i) {
    EXPECT_TRUE(refs[i].subtree == refs[i - 1].subtree || refs[i].local == 0) << i;
  }
}

TEST(PartitionCoverage, OneDensePointAmongOthers) {
  TestMesh mesh = WavySheet(40, 40);
  for (size_t i = 0; i < mesh.positions.size(); i += 2) mesh.positions[i] = {7, 7, 7};
  CheckedPartitionOf(TestSource(mesh), 14, 50);
}

TEST(PartitionCoverage, ADenseSpotIsRefined) {
  const TestScan result = CheckedPartitionOf(TestSource(DenseSpot(6000)), 29, 200);
  EXPECT_LE(Surplus(result, 200), 1.25);
}

TEST(PartitionCoverage, ALine) {
  const TestScan result = CheckedPartitionOf(TestSource(Line(5000)), 16, 300);
  EXPECT_LE(Surplus(result, 300), 1.25);
}

TEST(PartitionCoverage, APlane) { CheckedPartitionOf(TestSource(FlatPlane(70)), 16, 300); }

TEST(PartitionCoverage, TwoDistantComponentsStayApart) {
  const TestSource source(TwoComponents());
  const TestScan result = CheckedPartitionOf(source, 18, 1100);
  for (size_t i = 0; i < result.scan->subtree_count(); ++i) {
    const SubtreeSummary& summary = result.scan->summary(i);
    EXPECT_LT(summary.box_hi.x - summary.box_lo.x, 1 << 16);
  }
}

TEST(PartitionCoverage, SubtreesOfOneVertex) {
  const TestScan result = CheckedPartitionOf(TestSource(WavySheet(12, 15)), 12, 1);
  EXPECT_EQ(result.scan->subtree_count(), 180u);
}

TEST(PartitionCoverage, SubtreesOfOneVertexWhereVerticesCoincide) {
  const TestScan result = CheckedPartitionOf(TestSource(Soup(150, 200)), 10, 1);
  EXPECT_EQ(result.scan->subtree_count(), 150u);
}

TEST(PartitionCoverage, DegenerateAndDuplicateFacesAreKept) {
  for (uint32_t subtree_vertices : {2u, 3u, 17u, 64u, 1000u}) {
    CheckedPartitionOf(TestSource(Soup(1000, 3000)), 20, subtree_vertices);
  }
}

TEST(PartitionCoverage, LatticeOfOnePoint) {
  TestMesh mesh = WavySheet(30, 30);
  PartitionSettings settings;
  settings.subtree_vertices = 64;
  Lattice lattice;
  lattice.unit = 1e9;
  const TestSource source(mesh);
  const TestScan result = PartitionOf(source, lattice, settings);
  ExpectComplete(source, lattice, settings, *result.scan);
}

TEST(PartitionCoverage, EveryMetricIsComplete) {
  const TestSource source(Sphere(60, 60));
  const Lattice lattice = LatticeOf(source.mesh(), 17);
  for (const bool normal_metric : {false, true}) {
    for (const double a : {0.0, 0.5, 1.0}) {
      PartitionSettings settings;
      settings.subtree_vertices = 250;
      settings.normal_metric = normal_metric;
      settings.metric_a = a;
      settings.metric_b = 2.5;
      const TestScan result = PartitionOf(source, lattice, settings);
      ExpectComplete(source, lattice, settings, *result.scan);
    }
  }
}

TEST(PartitionCoverage, OnlyChunksAndVertexMapStayOnDisk) {
  const TestScan result = CheckedPartitionOf(TestSource(WavySheet(40, 40)), 17, 300);
  size_t maps = 0;
  for (const auto& entry : std::filesystem::directory_iterator(result.spill->path())) {
    const std::string name = entry.path().filename().string();
    const bool is_chunk = name.starts_with("partition.positions.") ||
                          name.starts_with("partition.faces.") ||
                          name.starts_with("partition.cross.");
    if (!is_chunk) ++maps;
    EXPECT_TRUE(is_chunk || name == "partition.vertex_map") << name;
  }
  EXPECT_EQ(maps, 1u);
}

}  // namespace
}  // namespace folprom::partition
