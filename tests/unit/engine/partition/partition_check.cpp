#include "partition_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace folprom::partition {
namespace {

struct ExpectedSubtree {
  std::vector<Int3> positions;
  std::vector<Face> faces;
  std::vector<CrossFace> cross_faces;
  std::set<uint32_t> neighbours;
};

bool Same(const CrossFace& a, const CrossFace& b) {
  return a.vertex == b.vertex && a.position == b.position;
}

// The plain way, from the vertex map alone.
std::vector<ExpectedSubtree> Expected(const TestMesh& mesh, const Lattice& lattice,
                                      std::span<const VertexRef> refs, size_t subtrees) {
  std::vector<ExpectedSubtree> expected(subtrees);
  std::vector<Int3> lattice_positions;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    lattice_positions.push_back(lattice.FromModel(mesh.positions[i].data()));
    ExpectedSubtree& subtree = expected.at(refs[i].subtree);
    EXPECT_EQ(refs[i].local, subtree.positions.size()) << "vertex " << i;
    subtree.positions.push_back(lattice_positions.back());
  }
  for (const io::Triangle& corners : mesh.triangles) {
    CrossFace face;
    std::set<uint32_t> touched;
    for (size_t i = 0; i < 3; ++i) {
      face.vertex[i] = refs[corners[i]];
      face.position[i] = lattice_positions[corners[i]];
      touched.insert(face.vertex[i].subtree);
    }
    if (touched.size() == 1) {
      expected[*touched.begin()].faces.push_back(
          {face.vertex[0].local, face.vertex[1].local, face.vertex[2].local});
      continue;
    }
    for (uint32_t subtree : touched) {
      expected[subtree].cross_faces.push_back(face);
      for (uint32_t other : touched) {
        if (other != subtree) expected[subtree].neighbours.insert(other);
      }
    }
  }
  return expected;
}

void ExpectBox(const ExpectedSubtree& expected, const SubtreeSummary& summary) {
  Int3 lo = expected.positions[0], hi = lo;
  for (const Int3& p : expected.positions) {
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y), std::min(lo.z, p.z)};
    hi = {std::max(hi.x, p.x), std::max(hi.y, p.y), std::max(hi.z, p.z)};
  }
  EXPECT_EQ(summary.box_lo, lo);
  EXPECT_EQ(summary.box_hi, hi);
}

void ExpectSubtree(const ExpectedSubtree& expected, const SubtreeSummary& summary,
                   const SubtreeChunk& chunk) {
  ASSERT_FALSE(expected.positions.empty());
  EXPECT_EQ(summary.vertices, expected.positions.size());
  EXPECT_EQ(summary.faces, expected.faces.size());
  EXPECT_EQ(summary.cross_faces, expected.cross_faces.size());
  EXPECT_TRUE(std::ranges::equal(summary.neighbours, expected.neighbours));
  EXPECT_TRUE(std::ranges::equal(chunk.positions, expected.positions));
  EXPECT_TRUE(std::ranges::equal(chunk.faces, expected.faces));
  EXPECT_TRUE(std::ranges::equal(chunk.cross_faces, expected.cross_faces, Same));
  ExpectBox(expected, summary);
}

template <class T>
void AppendBytes(std::span<const T> values, std::vector<uint8_t>* bytes) {
  const auto* begin = reinterpret_cast<const uint8_t*>(values.data());
  bytes->insert(bytes->end(), begin, begin + values.size_bytes());
}

}  // namespace

TestScan PartitionOf(const TestSource& source, const Lattice& lattice,
                     const PartitionSettings& settings, uint64_t memory_bytes,
                     parallel::Runner& runner) {
  TestScan result;
  result.spill = std::make_unique<io::SpillDirectory>("");
  parallel::Progress progress;
  result.scan =
      PartitionScan(source, lattice, settings, memory_bytes, runner, *result.spill, progress);
  EXPECT_EQ(progress.done(), progress.total());
  return result;
}

TestScan PartitionOf(const TestSource& source, const Lattice& lattice,
                     const PartitionSettings& settings) {
  const auto runner = parallel::MakeSerialRunner();
  return PartitionOf(source, lattice, settings, kTestMemory, *runner);
}

void ExpectComplete(const TestSource& source, const Lattice& lattice,
                    const PartitionSettings& settings, const PartitionedScan& scan) {
  ASSERT_EQ(scan.vertex_map().size(), source.vertex_count());
  for (const VertexRef& ref : scan.vertex_map()) ASSERT_LT(ref.subtree, scan.subtree_count());
  const auto expected = Expected(source.mesh(), lattice, scan.vertex_map(), scan.subtree_count());
  for (size_t i = 0; i < expected.size(); ++i) {
    SCOPED_TRACE("subtree " + std::to_string(i));
    EXPECT_LE(scan.summary(i).vertices, settings.subtree_vertices);
    ExpectSubtree(expected[i], scan.summary(i), scan.Load(i));
  }
}

TestScan CheckedPartitionOf(const TestSource& source, int bits, uint32_t subtree_vertices) {
  PartitionSettings settings;
  settings.subtree_vertices = subtree_vertices;
  const Lattice lattice = LatticeOf(source.mesh(), bits);
  TestScan result = PartitionOf(source, lattice, settings);
  ExpectComplete(source, lattice, settings, *result.scan);
  return result;
}

std::vector<uint8_t> BytesOf(const PartitionedScan& scan) {
  std::vector<uint8_t> bytes;
  AppendBytes(scan.vertex_map(), &bytes);
  for (size_t i = 0; i < scan.subtree_count(); ++i) {
    const SubtreeChunk chunk = scan.Load(i);
    AppendBytes(chunk.positions, &bytes);
    AppendBytes(chunk.faces, &bytes);
    AppendBytes(chunk.cross_faces, &bytes);
    AppendBytes(std::span<const uint32_t>(scan.summary(i).neighbours), &bytes);
  }
  return bytes;
}

}  // namespace folprom::partition
