#include "engine/codec/lattice_precision.h"

#include <gtest/gtest.h>

#include "engine/codec/tree_truth.h"

namespace folprom {
namespace {

/// A subtree whose two sets, not yet split, make a known error on a square in a plane.
class FlatTruth final : public SubtreeTruth {
 public:
  explicit FlatTruth(double distortion) : distortion_(distortion) {}
  bool OnGrid() const override { return false; }
  const uint8_t* Attributes(uint32_t) const override { return nullptr; }
  Int3 RootRepresentative() const override { return {}; }
  uint32_t ChildCount(uint32_t) const override { return 2; }
  double Distortion(uint32_t) const override { return distortion_; }
  LatticePrecision Precision(const Complex&, std::span<const uint32_t>, uint32_t) const override {
    return {};
  }
  Int3 ChildRepresentative(uint32_t, uint32_t) const override { return {}; }
  void BeginSplit(uint32_t, std::span<const uint32_t>) override {}
  void BeginBinarySplit(uint32_t, std::span<const uint32_t>, std::span<const uint32_t>) override {}
  bool FirstTouchesBorder() const override { return false; }
  bool SecondTouchesBorder() const override { return false; }
  void EndBinarySplit(uint32_t) override {}
  Int3 VertexPosition(uint32_t set) const override {
    return {set % 2 == 0 ? 0 : 1000, set / 2 == 0 ? 0 : 1000, 500};
  }
  CoordinateRest Rest(uint32_t, size_t) const override { return {}; }
  FitShares Fit(const SubtreeLod&, std::span<const uint32_t>, const FitShares&) const override {
    return {};
  }
  std::shared_ptr<const CoordinatePlanes> Planes() const override { return nullptr; }
  SplitOracle* oracle() override { return nullptr; }
  FaceCensus CountFaces(const Complex&) const override { return {}; }

 private:
  double distortion_;
};

Complex Square() {
  Complex complex;
  for (int i = 0; i < 4; ++i) complex.AddVertex();
  complex.AddFace(0, 1, 2);
  complex.AddFace(1, 3, 2);
  return complex;
}

constexpr std::array<uint32_t, 2> kOpen{0, 3};

TEST(LatticePrecision, IsFineAcrossAFlatSurfaceAndCoarseAlongIt) {
  // Twice 8e6 over an area of 1e6 is a distance of 16; a quarter of it allows cells of 16.
  const LatticePrecision precision = ChoosePrecision(Square(), FlatTruth(8e6), kOpen, 10);
  EXPECT_EQ(precision.tangential, 10u);
  EXPECT_EQ(precision.normal, 4u);
}

TEST(LatticePrecision, IsExactWhereNothingIsMissing) {
  EXPECT_EQ(ChoosePrecision(Square(), FlatTruth(0), kOpen, 10).normal, 0u);
  EXPECT_EQ(ChoosePrecision(Square(), FlatTruth(8e6), {}, 10).normal, 0u);
}

TEST(LatticePrecision, IsNeverCoarserThanAsked) {
  const LatticePrecision precision = ChoosePrecision(Square(), FlatTruth(1e30), kOpen, 3);
  EXPECT_EQ(precision.tangential, 3u);
  EXPECT_EQ(precision.normal, 3u);
}

TEST(LatticePrecision, OfPointsWithoutFacesIsTheCoarsest) {
  Complex points;
  for (int i = 0; i < 4; ++i) points.AddVertex();
  const LatticePrecision precision = ChoosePrecision(points, FlatTruth(8e6), kOpen, 5);
  EXPECT_EQ(precision.tangential, 5u);
  EXPECT_EQ(precision.normal, 5u);
}

}  // namespace
}  // namespace folprom
