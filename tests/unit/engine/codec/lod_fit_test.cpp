#include "engine/codec/lod_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/codec/fit_choice.h"
#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

constexpr int32_t kRadius = 100000;
constexpr uint32_t kSpokes = 6;

/// A pole and its ring on a sphere around the origin, `angle` away; all sets are open.
SubtreeLod Cap(double angle) {
  SubtreeLod lod;
  const auto add = [&](double from_pole, double around) {
    lod.complex.AddVertex();
    lod.positions.push_back({static_cast<int32_t>(kRadius * std::sin(from_pole) * std::cos(around)),
                             static_cast<int32_t>(kRadius * std::sin(from_pole) * std::sin(around)),
                             static_cast<int32_t>(kRadius * std::cos(from_pole))});
    lod.sets.emplace_back();
  };
  add(0, 0);
  const double turn = 2 * std::acos(-1.0) / kSpokes;
  for (uint32_t i = 0; i < kSpokes; ++i) add(angle, turn * i);
  for (uint32_t i = 0; i < kSpokes; ++i) {
    const uint32_t a = 1 + i, b = 1 + (i + 1) % kSpokes;
    lod.complex.AddEdge(0, a);
    lod.complex.AddEdge(a, b);
    lod.complex.AddFace(0, a, b);
  }
  return lod;
}

/// Points of the sphere over the middles of the faces of a cap.
std::vector<FitSample> OverTheFaces(double angle) {
  std::vector<FitSample> samples;
  const double turn = 2 * std::acos(-1.0) / kSpokes, from_pole = angle * 0.6;
  for (uint32_t i = 0; i < kSpokes; ++i) {
    const double around = turn * (i + 0.5);
    samples.push_back({0,
                       {static_cast<int32_t>(kRadius * std::sin(from_pole) * std::cos(around)),
                        static_cast<int32_t>(kRadius * std::sin(from_pole) * std::sin(around)),
                        static_cast<int32_t>(kRadius * std::cos(from_pole))}});
  }
  return samples;
}

TEST(LodFit, MovesAVertexToTheOuterSideOfItsBend) {
  const auto move = FitMoveOf(Cap(0.3), 0);
  ASSERT_TRUE(move);
  // The pole stands 1 - cos(0.3) of the radius over its ring.
  EXPECT_NEAR(move->shift[2], kRadius * (1 - std::cos(0.3)), 2);
  EXPECT_NEAR(move->shift[0], 0, 2);
  EXPECT_EQ(move->bend, 2u);
}

TEST(LodFit, TellsSurfacesApartByTheirBend) {
  EXPECT_EQ(FitMoveOf(Cap(0.01), 0)->bend, 0u);
  EXPECT_EQ(FitMoveOf(Cap(0.15), 0)->bend, 1u);
  EXPECT_EQ(FitMoveOf(Cap(0.9), 0)->bend, 3u);
}

TEST(LodFit, LeavesOtherVerticesWhereTheyAre) {
  SubtreeLod leaf = Cap(0.3), border = Cap(0.3);
  leaf.sets[0].is_leaf = true;
  EXPECT_FALSE(FitMoveOf(leaf, 0));
  border.sets[0].border = 0;
  EXPECT_FALSE(FitMoveOf(border, 0));
  EXPECT_FALSE(FitMoveOf(Cap(0.3), 1)) << "at the rim";
  SubtreeLod alone;
  alone.complex.AddVertex();
  alone.positions.push_back({0, 0, 0});
  alone.sets.emplace_back();
  EXPECT_FALSE(FitMoveOf(alone, 0));
}

TEST(LodFit, MovesLessAmongLeaves) {
  SubtreeLod lod = Cap(0.3);
  const double among_open = FitMoveOf(lod, 0)->shift[2];
  for (uint32_t v = 1; v <= kSpokes; ++v) lod.sets[v].is_leaf = true;
  EXPECT_NEAR(FitMoveOf(lod, 0)->shift[2], among_open / (kSpokes + 1), 1e-9);
}

TEST(LodFit, MovesNoFurtherThanAllowed) {
  LodFit fit;
  BitEncoder encoder;
  fit.Code(encoder, {7, 7, 7, 7});
  const FitMove move{0, 1, {30, 40, 0}};
  const Vector3 free = fit.ShiftOf(move, 1000), held = fit.ShiftOf(move, 5);
  EXPECT_NEAR(free[0], 30 * 7 * kShareStep, 1e-9);
  EXPECT_NEAR(held[0], 3, 1e-9);
  EXPECT_NEAR(held[1], 4, 1e-9);
}

TEST(LodFit, GivesSharesBackAndCostsLittleWhereTheyStay) {
  LodFit written, read;
  BitEncoder encoder;
  std::vector<FitShares> all(40, FitShares{4, 0, 3, 7});
  all.push_back({0, 7, 3, 7});
  for (const FitShares& shares : all) written.Code(encoder, shares);
  const auto bytes = encoder.TakeSegment();
  EXPECT_LT(bytes.size(), 16u);
  BitDecoder decoder;
  decoder.StartSegment(bytes);
  for (const FitShares& shares : all) {
    read.Code(decoder, FitShares{});
    ASSERT_EQ(read.shares(), shares);
  }
}

TEST(ChooseFit, BringsFacesOfASphereNearerToIt) {
  const FitShares chosen = ChooseFit(Cap(0.3), OverTheFaces(0.3), {});
  EXPECT_EQ(chosen[2], kLargestShare) << "where the pole alone may move, it moves far";
  EXPECT_EQ(chosen[0], 0u);
}

TEST(ChooseFit, KeepsVerticesOnAMeshWhoseVerticesItHas) {
  std::vector<FitSample> samples;
  const SubtreeLod cap = Cap(0.3);
  samples.push_back({0, cap.positions[0]});
  EXPECT_EQ(ChooseFit(cap, samples, {0, 0, 5, 0})[2], 0u);
  EXPECT_EQ(ChooseFit(cap, {}, {0, 0, 5, 0}), (FitShares{0, 0, 5, 0})) << "nothing to go by";
}

}  // namespace
}  // namespace folprom
