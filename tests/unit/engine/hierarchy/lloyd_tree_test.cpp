#include "engine/hierarchy/lloyd_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "engine/hierarchy/surface.h"

namespace folprom {
namespace {

constexpr int32_t kSide = 1 << 17;

std::vector<Int3> RandomCloud(uint64_t seed, size_t count) {
  std::mt19937_64 random(seed);
  std::vector<Int3> points;
  for (size_t i = 0; i < count; ++i) {
    auto draw = [&] { return static_cast<int32_t>(random() % kSide); };
    points.push_back({draw(), draw(), draw()});
  }
  return points;
}

struct Sheet {
  std::vector<Int3> positions;
  std::vector<Face> faces;
};

Sheet WavySheet(uint32_t side) {
  Sheet sheet;
  for (uint32_t i = 0; i < side * side; ++i) {
    const double x = i % side, y = i / side;
    sheet.positions.push_back(
        {static_cast<int32_t>(x * 1000), static_cast<int32_t>(y * 1000),
         static_cast<int32_t>(5000 + 4000 * std::sin(x * 0.3) * std::cos(y * 0.2))});
    if (i % side + 1 == side || i / side + 1 == side) continue;
    sheet.faces.push_back({i, i + 1, i + side});
    sheet.faces.push_back({i + 1, i + side + 1, i + side});
  }
  return sheet;
}

SetTree TreeOf(const std::vector<Int3>& positions, const std::vector<Face>& faces,
               const CodecSettings& settings) {
  return BuildLloydTree(positions, MeasureSurface(positions, faces, {}, 0), kSide, settings);
}

/// Checks the promises of SetTree and returns the depth of the deepest node.
uint32_t CheckedDepth(const SetTree& tree, const std::vector<Int3>& positions, uint32_t children) {
  std::vector<uint32_t> order = tree.order();
  std::sort(order.begin(), order.end());
  EXPECT_EQ(order.size(), positions.size());
  for (uint32_t i = 0; i < order.size(); ++i) {
    if (order[i] != i) {
      ADD_FAILURE() << "the order is no permutation";
      return 0;
    }
  }
  EXPECT_EQ(tree.node(0).begin, 0u);
  EXPECT_EQ(tree.node(0).end, positions.size());
  uint32_t deepest = 0;
  size_t leaves = 0;
  std::vector<std::pair<uint32_t, uint32_t>> pending{{0, 0}};
  while (!pending.empty()) {
    const auto [index, depth] = pending.back();
    pending.pop_back();
    deepest = std::max(deepest, depth);
    const SetTree::Node& node = tree.node(index);
    const uint32_t size = node.end - node.begin;
    EXPECT_GT(size, 0u);
    if (size == 1) {
      ++leaves;
      EXPECT_EQ(node.child_count, 0u);
      EXPECT_EQ(node.representative, positions[tree.VerticesOf(index)[0]]);
      continue;
    }
    // As many children as vertices where there are few, else K.
    EXPECT_EQ(node.child_count, std::min(size, children));
    uint32_t next = node.begin;
    for (uint32_t c = 0; c < node.child_count; ++c) {
      const SetTree::Node& child = tree.node(node.first_child + c);
      EXPECT_EQ(child.begin, next);
      EXPECT_GT(child.end, child.begin);
      next = child.end;
      pending.push_back({node.first_child + c, depth + 1});
    }
    EXPECT_EQ(next, node.end);
    // The representative lies in the box of its set.
    for (int32_t Int3::*axis : {&Int3::x, &Int3::y, &Int3::z}) {
      int32_t lo = kSide * 8192, hi = 0;
      for (uint32_t v : tree.VerticesOf(index)) {
        lo = std::min(lo, positions[v].*axis);
        hi = std::max(hi, positions[v].*axis);
      }
      EXPECT_GE(node.representative.*axis, lo);
      EXPECT_LE(node.representative.*axis, hi);
    }
    if (::testing::Test::HasFailure()) return 0;
  }
  EXPECT_EQ(leaves, positions.size());
  return deepest;
}

std::vector<CodecSettings> AllSettings() {
  std::vector<CodecSettings> all;
  for (uint32_t children : {2u, 3u, 4u, 8u}) {
    for (bool metric : {true, false}) {
      CodecSettings settings;
      settings.children = children;
      settings.normal_metric = metric;
      settings.representative = metric ? Representative::kCurvature : Representative::kCentre;
      all.push_back(settings);
    }
  }
  return all;
}

TEST(LloydTree, ChildrenPartTheirSet) {
  const Sheet sheet = WavySheet(40);
  for (const CodecSettings& settings : AllSettings()) {
    const uint32_t depth = CheckedDepth(TreeOf(sheet.positions, sheet.faces, settings),
                                        sheet.positions, settings.children);
    ASSERT_FALSE(HasFailure());
    EXPECT_LE(depth, 48u);
    for (size_t count : {1u, 2u, 3u, 4u, 5u, 9u, 300u}) {
      const auto cloud = RandomCloud(count, count);
      CheckedDepth(TreeOf(cloud, {}, settings), cloud, settings.children);
      ASSERT_FALSE(HasFailure()) << count;
    }
  }
}

TEST(LloydTree, OfCoincidentVerticesStaysFlat) {
  const std::vector<Int3> one_place(5000, {7, 8, 9});
  std::vector<Int3> two_places = one_place;
  for (size_t i = 0; i < two_places.size(); i += 3) two_places[i] = {kSide - 1, 8, 9};
  std::vector<Int3> one_apart = one_place;
  one_apart[1234] = {kSide - 1, 0, 0};
  for (const CodecSettings& settings : AllSettings()) {
    for (const auto& positions : {one_place, two_places, one_apart}) {
      const uint32_t depth =
          CheckedDepth(TreeOf(positions, {}, settings), positions, settings.children);
      ASSERT_FALSE(HasFailure());
      // log2(5000) and a little for the way there.
      EXPECT_LE(depth, 20u);
    }
  }
}

TEST(LloydTree, OfExponentiallySpacedVerticesDoesNotGrowDeepWithTheirNumber) {
  // Each split parts the few farthest from the rest, so the tree would be a chain.
  for (const CodecSettings& settings : AllSettings()) {
    std::vector<Int3> positions;
    for (int copy = 0; copy < 400; ++copy) {
      for (int bit = 0; bit < 30; ++bit) positions.push_back({1 << bit, copy % 7, copy % 3});
    }
    const uint32_t depth =
        CheckedDepth(TreeOf(positions, {}, settings), positions, settings.children);
    ASSERT_FALSE(HasFailure());
    // 48 levels, and then halves.
    EXPECT_LE(depth, 48u + 14u);
  }
}

TEST(LloydTree, IsTheSameEachTime) {
  const Sheet sheet = WavySheet(30);
  const SetTree first = TreeOf(sheet.positions, sheet.faces, {});
  const SetTree second = TreeOf(sheet.positions, sheet.faces, {});
  EXPECT_EQ(first.order(), second.order());
}

TEST(LloydTree, PartsFarClusters) {
  // Four clouds in four corners are the four children.
  std::mt19937_64 random(4);
  std::vector<Int3> positions;
  for (int i = 0; i < 400; ++i) {
    auto near = [&](bool far) {
      return (far ? 100000 : 0) + static_cast<int32_t>(random() % 3000);
    };
    positions.push_back({near(i % 4 >= 2), near(i % 2 == 1), near(false)});
  }
  const SetTree tree = TreeOf(positions, {}, {});
  ASSERT_EQ(tree.node(0).child_count, 4u);
  for (uint32_t c = 0; c < 4; ++c) {
    const auto vertices = tree.VerticesOf(tree.node(0).first_child + c);
    EXPECT_EQ(vertices.size(), 100u);
    for (uint32_t v : vertices) EXPECT_EQ(v % 4, vertices[0] % 4);
  }
}

TEST(LloydTree, RepresentativeIsAVertexWhereCurvatureVaries) {
  // A plane with one sharp tip: the tip stands for its sets as long as it can.
  Sheet sheet = WavySheet(21);
  for (Int3& p : sheet.positions) p.z = 0;
  const uint32_t tip = 10 * 21 + 10;
  sheet.positions[tip].z = 9000;
  CodecSettings settings;
  settings.representative = Representative::kCurvature;
  settings.gaussian_ratio = 100;
  settings.curvature_threshold = 0.01;
  const SetTree tree = TreeOf(sheet.positions, sheet.faces, settings);
  const Int3 root = tree.node(0).representative;
  EXPECT_NE(std::find(sheet.positions.begin(), sheet.positions.end(), root), sheet.positions.end());
  const int32_t off = std::max(std::abs(root.x - 10000), std::abs(root.y - 10000));
  EXPECT_LE(off, 1000) << "the tip or a vertex beside it";
  settings.representative = Representative::kCentre;
  EXPECT_LT(TreeOf(sheet.positions, sheet.faces, settings).node(0).representative.z, 100);
}

/// Cap of a sphere of this radius around (20000, 20000, 0).
constexpr double kCapRadius = 30000;
Sheet Cap() {
  Sheet cap = WavySheet(41);
  for (Int3& p : cap.positions) {
    const double x = p.x - 20000, y = p.y - 20000;
    p.z = static_cast<int32_t>(std::sqrt(kCapRadius * kCapRadius - x * x - y * y));
  }
  return cap;
}

/// How far outside the sphere the root's grandchildren are in the mean.
double HeightAboveTheCap(Representative representative) {
  const Sheet cap = Cap();
  CodecSettings settings;
  settings.representative = representative;
  const SetTree tree = TreeOf(cap.positions, cap.faces, settings);
  double sum = 0;
  uint32_t count = 0;
  for (uint32_t c = 0; c < 4; ++c) {
    const SetTree::Node& child = tree.node(tree.node(0).first_child + c);
    for (uint32_t g = 0; g < child.child_count; ++g, ++count) {
      const Int3 p = tree.node(child.first_child + g).representative;
      sum += std::hypot(p.x - 20000.0, p.y - 20000.0, p.z) - kCapRadius;
    }
  }
  return sum / count;
}

TEST(LloydTree, QuadricRepresentativesDoNotShrinkAConvexSurface) {
  // Faces cut below the surface: corners on it, or inside as centres are, shrink the LOD.
  EXPECT_GT(HeightAboveTheCap(Representative::kQuadric), 0);
  EXPECT_LT(HeightAboveTheCap(Representative::kQuadric), 600);
  EXPECT_LT(HeightAboveTheCap(Representative::kCentre), -200);
}

TEST(LloydTree, QuadricRepresentativesStayInTheBoxOfAllVertices) {
  // Planes that meet far outside, and vertices without any.
  Sheet cap = Cap();
  const Sheet bare{cap.positions, {}};
  for (const Sheet& sheet : {cap, bare}) {
    const SetTree tree = TreeOf(sheet.positions, sheet.faces, CodecSettings());
    const Int3 root = tree.node(0).representative;
    EXPECT_TRUE(root.x >= 0 && root.x <= 40000 && root.y >= 0 && root.y <= 40000);
    EXPECT_TRUE(root.z >= 0 && root.z <= 30000);
  }
}

TEST(LloydTree, DistortionFallsFromSetsToTheirChildren) {
  const Sheet cap = Cap();
  const SetTree tree = TreeOf(cap.positions, cap.faces, CodecSettings());
  const SetTree::Node& root = tree.node(0);
  double children = 0;
  for (uint32_t c = 0; c < root.child_count; ++c) {
    children += tree.node(root.first_child + c).distortion;
  }
  EXPECT_GT(children, 0);
  EXPECT_LT(children, root.distortion / 2);
}

}  // namespace
}  // namespace folprom
