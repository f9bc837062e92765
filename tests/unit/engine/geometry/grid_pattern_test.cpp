#include "engine/geometry/grid_pattern.h"

#include <gtest/gtest.h>

namespace folprom {
namespace {

/// A vertex of a grid, 0, whose neighbours 2 and 4 beside it have been split into 3 and 5; the
/// neighbour beyond is 1.
struct Cross {
  std::vector<Int3> positions{{1000, 1000, 500}, {1100, 1000, 500}, {1000, 1100, 500},
                              {1050, 1100, 504}, {1000, 900, 500},  {1050, 900, 496}};
  Complex complex;
  GridPattern pattern;

  Cross() {
    for (size_t v = 0; v < positions.size(); ++v) complex.AddVertex();
    for (uint32_t v = 1; v < positions.size(); ++v) complex.AddEdge(0, v);
    complex.AddEdge(1, 3);
    complex.AddEdge(2, 3);
    complex.AddEdge(4, 5);
    complex.AddEdge(1, 5);
    complex.AddFace(0, 1, 3);
    complex.AddFace(0, 3, 2);
    complex.AddFace(0, 4, 5);
    complex.AddFace(0, 5, 1);
    pattern.AddRoot();
    pattern.AddSplit(0, 1);
    pattern.AddSplit(0, 2);
    pattern.AddSplit(2, 3);
    pattern.AddSplit(0, 4);
    pattern.AddSplit(4, 5);
  }
};

TEST(GridPattern, ExpectsTheStepOfTheNeighbours) {
  const Cross cross;
  const GridHint hint = cross.pattern.Expect(cross.complex, cross.positions, 0);
  ASSERT_TRUE(hint.found);
  EXPECT_EQ(hint.support, GridHint::kMostSupport);
  EXPECT_EQ(hint.step, (Vector3{50, 0, 0}));
  EXPECT_EQ(hint.far_vertex, 1u);
  EXPECT_EQ(hint.far, (Vector3{100, 0, 0}));
  EXPECT_EQ(hint.across, (Vector3{100, 0, 0}));
}

TEST(GridPattern, TellsWhatNeighboursAreToTheSplitsThatAgree) {
  const Cross cross;
  const GridHint hint = cross.pattern.Expect(cross.complex, cross.positions, 0);
  ASSERT_EQ(hint.count, 5u);
  const GridHint::Mark expected[] = {GridHint::kOther, GridHint::kOther,  GridHint::kParent,
                                     GridHint::kChild, GridHint::kParent, GridHint::kChild};
  for (uint32_t k = 0; k < hint.count; ++k) EXPECT_EQ(hint.mark[k], expected[hint.neighbour[k]]);
}

TEST(GridPattern, ExpectsNothingWithoutANeighbourBeyond) {
  Cross cross;
  cross.positions[1] = {1300, 1300, 500};
  const GridHint hint = cross.pattern.Expect(cross.complex, cross.positions, 0);
  // Its own step before the last, halved, still leads half the way to a neighbour.
  EXPECT_NE(hint.far_vertex, 1u);
  EXPECT_EQ(hint.support, 0u);
}

TEST(GridPattern, RemembersHowSplitsPartedTheRing) {
  const Cross cross;
  GridPattern pattern;
  pattern.AddRoot();
  pattern.AddSplit(0, 1);
  pattern.AddSplit(0, 2);
  pattern.AddSplit(2, 3);
  pattern.SetKind(2);
  pattern.AddSplit(0, 4);
  pattern.AddSplit(4, 5);
  EXPECT_EQ(pattern.Expect(cross.complex, cross.positions, 0).kind, 2);
}

TEST(GridPattern, CountsNeighboursThatMadeTheSameStep) {
  const Cross cross;
  const auto peers = [&](bool leaves) {
    return cross.pattern.PeersOf(cross.complex, cross.positions, 2,
                                 [&](uint32_t) { return leaves; });
  };
  EXPECT_EQ(peers(true).leaves, 1u);
  EXPECT_EQ(peers(true).split, 0u);
  EXPECT_EQ(peers(false).leaves, 0u);
}

}  // namespace
}  // namespace folprom
