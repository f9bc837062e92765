// Depth images: regular grids with holes and jumps of the depth.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "tests/support/codec.h"
#include "tests/support/files.h"
#include "tests/support/ply.h"
#include "tests/support/same_mesh.h"
#include "tests/support/surfaces.h"

namespace folprom::support {
namespace {

EncodeOptions Options(uint32_t subtree_vertices) {
  EncodeOptions options;
  options.bits = 16;
  options.codec.hierarchy = Hierarchy::kQuadric;
  options.codec.offsets = Offsets::kLattice;
  options.codec.subtree_vertices = subtree_vertices;
  return options;
}

/// Bits per vertex; checks that the mesh comes back.
double CodeLosslessly(const Mesh& mesh, uint32_t subtree_vertices) {
  TemporaryFolder folder;
  const std::string scan = folder.File("scan.ply"), folp = folder.File("scan.folp");
  WritePly(scan, mesh, CoordinateType::kInt);
  const EncodeReport report = Encode(scan, folp, Options(subtree_vertices));
  const VerifyReport verified = Verify(folp, scan);
  EXPECT_TRUE(verified.lossless) << verified.reason;
  return 8 * static_cast<double>(report.bytes) / static_cast<double>(report.vertices);
}

TEST(RangeGridTest, ComesBackWhole) { CodeLosslessly(RangeGrid(90, 70, 1), 1 << 24); }

TEST(RangeGridTest, ComesBackWholeFromSubtrees) { CodeLosslessly(RangeGrid(90, 70, 2), 700); }

TEST(RangeGridTest, ComesBackWholeBesideAnIrregularSurface) {
  Mesh mesh = RangeGrid(60, 50, 3);
  const Mesh other = BumpySphere(1500, true, 1);
  const uint64_t first = mesh.positions.size();
  for (Point p : other.positions) mesh.positions.push_back({p[0] * 20000, p[1] * 20000, p[2]});
  for (Triple f : other.faces) mesh.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
  TemporaryFolder folder;
  const std::string scan = folder.File("scan.ply"), folp = folder.File("scan.folp");
  WritePly(scan, mesh, CoordinateType::kDouble);
  Encode(scan, folp, Options(1 << 24));
  const VerifyReport verified = Verify(folp, scan);
  EXPECT_TRUE(verified.lossless) << verified.reason;
}

TEST(RangeGridTest, CostsMuchLessThanTheSamePointsWithRandomDiagonals) {
  Mesh grid = RangeGrid(120, 100, 4);
  // Smoothly bent, so that pixels share no coordinate: that would serve the other mesh too.
  for (Point& position : grid.positions) {
    position[0] += position[0] * (position[0] + position[1]) / 1e6;
  }
  Mesh irregular = grid;
  // Two faces that follow each other and share an edge are a cell: every third gets its other
  // diagonal.
  for (size_t f = 0; f + 1 < irregular.faces.size(); f += 2) {
    Triple &a = irregular.faces[f], &b = irregular.faces[f + 1];
    if ((f / 2 * 7919) % 3 != 0) continue;
    for (size_t i = 0; i < 3; ++i) {
      for (size_t k = 0; k < 3; ++k) {
        if (a[i] != b[(k + 1) % 3] || a[(i + 1) % 3] != b[k]) continue;
        const uint64_t from = a[i], to = a[(i + 1) % 3];
        const uint64_t left = a[(i + 2) % 3], right = b[(k + 2) % 3];
        a = {left, from, right};
        b = {right, to, left};
        i = k = 3;
      }
    }
  }
  EXPECT_LT(CodeLosslessly(grid, 1 << 24), 0.75 * CodeLosslessly(irregular, 1 << 24));
}

}  // namespace
}  // namespace folprom::support
