#include "engine/hierarchy/contraction_mesh.h"

#include <gtest/gtest.h>

#include <vector>

namespace folprom {
namespace {

constexpr float kLengthWeight = 0.015F;

/// Columns x rows points of a plane, two faces a square.
struct Sheet {
  uint32_t columns, rows;
  std::vector<Int3> positions;
  std::vector<Face> faces;

  Sheet(uint32_t columns_in, uint32_t rows_in) : columns(columns_in), rows(rows_in) {
    for (uint32_t y = 0; y < rows; ++y) {
      for (uint32_t x = 0; x < columns; ++x) {
        positions.push_back({static_cast<int32_t>(100 * x), static_cast<int32_t>(100 * y), 0});
        if (x == 0 || y == 0) continue;
        const uint32_t a = At(x - 1, y - 1), b = At(x, y - 1), c = At(x, y), d = At(x - 1, y);
        faces.push_back({a, b, c});
        faces.push_back({a, c, d});
      }
    }
  }
  uint32_t At(uint32_t x, uint32_t y) const { return y * columns + x; }
};

TEST(ContractionMesh, AStripIsNotPinchedAcross) {
  const Sheet strip(7, 2);
  ContractionMesh mesh(strip.positions, strip.faces, {}, 0);
  const uint32_t low = strip.At(3, 0), high = strip.At(3, 1);
  mesh.CollectRing(low);
  EXPECT_TRUE(mesh.PinchesRims(low, high)) << "both ends of the edge are open";
  EXPECT_FALSE(mesh.PinchesRims(low, strip.At(4, 0))) << "along the border";
}

TEST(ContractionMesh, AVertexOfTheBorderMayGoInsideAndOneInsideToTheBorder) {
  const Sheet sheet(7, 5);
  ContractionMesh mesh(sheet.positions, sheet.faces, {}, 0);
  mesh.CollectRing(sheet.At(3, 0));
  EXPECT_TRUE(mesh.IsAllowed(sheet.At(3, 0), sheet.At(3, 1)));
  EXPECT_FALSE(mesh.PinchesRims(sheet.At(3, 0), sheet.At(3, 1)));
  mesh.CollectRing(sheet.At(3, 1));
  EXPECT_TRUE(mesh.IsAllowed(sheet.At(3, 1), sheet.At(3, 0)));
  EXPECT_FALSE(mesh.PinchesRims(sheet.At(3, 1), sheet.At(3, 0)));
}

TEST(ContractionMesh, RimsMeetAtAHubRatherThanThatEachSpokeGoesThroughAllOfIt) {
  for (const int32_t spokes : {10, 5000}) {
    std::vector<Int3> positions{{0, 0, 0}};
    std::vector<Face> faces;
    for (int32_t i = 0; i < spokes; ++i) {
      positions.push_back({100 * i, 100 * spokes, 0});
      const auto last = static_cast<uint32_t>(positions.size() - 1);
      if (i > 0) faces.push_back({0, last, last - 1});
    }
    ContractionMesh mesh(positions, faces, {}, 0);
    mesh.CollectRing(5);
    EXPECT_EQ(mesh.PinchesRims(5, 0), spokes == 10);
  }
}

/// Faces into another subtree below the lowest row.
std::vector<CrossFace> FacesBelow(const Sheet& sheet) {
  std::vector<CrossFace> faces;
  for (uint32_t x = 0; x + 1 < sheet.columns; ++x) {
    CrossFace& face = faces.emplace_back();
    face.vertex = {{{1, x}, {0, sheet.At(x + 1, 0)}, {0, sheet.At(x, 0)}}};
    const auto left = static_cast<int32_t>(100 * x);
    face.position = {Int3{left, -100, 0}, sheet.positions[x + 1], sheet.positions[x]};
  }
  return faces;
}

TEST(ContractionMesh, LeavingTheBorderToAnotherSubtreeCostsMore) {
  const Sheet sheet(7, 5);
  const std::vector<CrossFace> below = FacesBelow(sheet);
  ContractionMesh mesh(sheet.positions, sheet.faces, below, 0);
  const uint32_t border = sheet.At(3, 0), inside = sheet.At(3, 1);
  const float along = mesh.CostOf(border, sheet.At(4, 0), kLengthWeight);
  EXPECT_GT(mesh.CostOf(border, inside, kLengthWeight), 4 * along);
  EXPECT_LT(mesh.CostOf(inside, sheet.At(3, 2), kLengthWeight), 4 * along);
  // What has taken in a vertex of the border is at the border.
  mesh.CollectRing(border);
  ASSERT_TRUE(mesh.IsAllowed(border, inside));
  mesh.Contract(border, inside);
  EXPECT_GT(mesh.CostOf(inside, sheet.At(3, 2), kLengthWeight),
            4 * mesh.CostOf(inside, sheet.At(4, 0), kLengthWeight));
}

}  // namespace
}  // namespace folprom
