#include "engine/hierarchy/surface.h"

#include <gtest/gtest.h>

namespace folprom {
namespace {

const std::vector<Int3> kRoof = {{0, 0, 0},   {100, 0, 100},   {200, 0, 0},
                                 {0, 100, 0}, {100, 100, 100}, {200, 100, 0}};
const std::vector<Face> kRoofFaces = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};

TEST(MeasureSurface, GivesUnitNormalsAndCurvatureOfARoof) {
  const SurfaceAttributes surface = MeasureSurface(kRoof, kRoofFaces, {}, 0);
  for (const auto& n : surface.normals) {
    EXPECT_NEAR(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1, 1e-12);
  }
  // On one side of the ridge all faces agree; on it they lean 45 degrees to either side.
  EXPECT_NEAR(surface.curvature[0], 0, 1e-7);
  EXPECT_NEAR(surface.curvature[3], 0, 1e-7);
  EXPECT_NEAR(surface.normals[0][0], -surface.normals[0][2], 1e-12);
  EXPECT_GT(surface.curvature[1], 0.4);
  EXPECT_GT(surface.curvature[4], 0.4);
  for (double curvature : surface.curvature) {
    EXPECT_GE(curvature, 0);
    EXPECT_LE(curvature, 1);
  }
}

TEST(MeasureSurface, TakesCrossFacesAsItsOwn) {
  // The roof cut along its ridge: vertices 0 1 3 4 here, 2 and 5 elsewhere.
  const std::vector<Int3> here = {kRoof[0], kRoof[1], kRoof[3], kRoof[4]};
  const std::vector<Face> faces = {{0, 1, 3}, {0, 3, 2}};
  const std::vector<CrossFace> cross = {
      {{{{4, 1}, {9, 0}, {9, 1}}}, {kRoof[1], kRoof[2], kRoof[5]}},
      {{{{4, 1}, {9, 1}, {4, 3}}}, {kRoof[1], kRoof[5], kRoof[4]}}};
  const SurfaceAttributes whole = MeasureSurface(kRoof, kRoofFaces, {}, 0);
  const SurfaceAttributes part = MeasureSurface(here, faces, cross, 4);
  const size_t same[] = {0, 1, 3, 4};
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(part.curvature[i], whole.curvature[same[i]], 1e-12);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(part.normals[i][k], whole.normals[same[i]][k], 1e-12);
    }
  }
}

TEST(MeasureSurface, IsZeroWithoutFacesAndOnDegenerateOnes) {
  const std::vector<Int3> points = {{0, 0, 0}, {5, 5, 5}, {10, 10, 10}, {10, 10, 10}};
  const SurfaceAttributes surface =
      MeasureSurface(points, std::vector<Face>{{0, 1, 2}, {2, 3, 0}, {1, 1, 1}}, {}, 0);
  for (size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(surface.curvature[i], 0);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(surface.normals[i][k], 0);
  }
}

}  // namespace
}  // namespace folprom
