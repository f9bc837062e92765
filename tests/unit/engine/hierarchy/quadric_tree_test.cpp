#include "engine/hierarchy/quadric_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "engine/hierarchy/cost_queue.h"
#include "engine/hierarchy/quadric.h"

namespace folprom {
namespace {

struct Sheet {
  std::vector<Int3> positions;
  std::vector<Face> faces;
};

/// A grid of side x side vertices; height 0 is flat.
Sheet GridSheet(uint32_t side, double height) {
  Sheet sheet;
  for (uint32_t i = 0; i < side * side; ++i) {
    const double x = i % side, y = i / side;
    sheet.positions.push_back(
        {static_cast<int32_t>(x * 1000), static_cast<int32_t>(y * 1000),
         static_cast<int32_t>(5000 + height * std::sin(x * 0.3) * std::cos(y * 0.2))});
    if (i % side + 1 == side || i / side + 1 == side) continue;
    sheet.faces.push_back({i, i + 1, i + side});
    sheet.faces.push_back({i + 1, i + side + 1, i + side});
  }
  return sheet;
}

SetTree TreeOf(const Sheet& sheet, double length_weight = 0.03) {
  CodecSettings settings;
  settings.length_weight = length_weight;
  return BuildQuadricTree(sheet.positions, sheet.faces, {}, 0, settings);
}

/// Checks every promise of the tree.
void ExpectSound(const SetTree& tree, const std::vector<Int3>& positions) {
  const auto count = static_cast<uint32_t>(positions.size());
  std::vector<uint32_t> order = tree.order();
  std::sort(order.begin(), order.end());
  ASSERT_EQ(order.size(), count);
  for (uint32_t i = 0; i < count; ++i) ASSERT_EQ(order[i], i) << "the order is no permutation";
  ASSERT_EQ(tree.node(0).begin, 0u);
  ASSERT_EQ(tree.node(0).end, count);
  uint32_t nodes = 0;
  std::vector<uint32_t> open{0};
  while (!open.empty()) {
    const uint32_t index = open.back();
    open.pop_back();
    ++nodes;
    const SetTree::Node& node = tree.node(index);
    ASSERT_TRUE(std::isfinite(node.distortion) && node.distortion >= 0);
    if (node.end - node.begin == 1) {
      ASSERT_EQ(node.child_count, 0u);
      ASSERT_EQ(node.representative, positions[tree.VerticesOf(index)[0]]);
      continue;
    }
    ASSERT_EQ(node.child_count, 2u);
    const SetTree::Node& kept = tree.node(node.first_child);
    const SetTree::Node& added = tree.node(node.first_child + 1);
    ASSERT_EQ(kept.begin, node.begin);
    ASSERT_EQ(kept.end, added.begin);
    ASSERT_EQ(added.end, node.end);
    ASSERT_LT(kept.begin, kept.end);
    ASSERT_LT(added.begin, added.end);
    // Down to a leaf this makes every representative a vertex of its set.
    ASSERT_EQ(kept.representative, node.representative);
    ASSERT_GE(node.distortion, std::max(kept.distortion, added.distortion));
    open.push_back(node.first_child);
    open.push_back(node.first_child + 1);
  }
  ASSERT_EQ(nodes, 2 * count - 1);
}

void ExpectEqualTrees(const SetTree& a, const SetTree& b) {
  ASSERT_EQ(a.order(), b.order());
  for (uint32_t i = 0; i + 1 < 2 * a.order().size(); ++i) {
    const SetTree::Node &l = a.node(i), &r = b.node(i);
    ASSERT_TRUE(l.begin == r.begin && l.end == r.end && l.first_child == r.first_child);
    ASSERT_EQ(l.representative, r.representative);
    ASSERT_EQ(l.distortion, r.distortion);
  }
}

TEST(Quadric, IsTheWeightedSquaredDistanceFromItsPlanes) {
  Quadric a, b;
  a.AddPlane({0, 0, 1}, 2);
  b.AddPlane({0.6, 0.8, 0}, 3);
  EXPECT_EQ(a.At({100, -7, 0}), 0);
  EXPECT_FLOAT_EQ(a.At({1, 2, 4}), 2 * 16);
  EXPECT_FLOAT_EQ(b.At({5, 10, 3}), 3 * 121);
  // The other lies at (10, 20, 30), and its plane goes through there.
  a.Add(b, {10, 20, 30});
  EXPECT_EQ(a.weight, 5);
  EXPECT_FLOAT_EQ(a.At({0, 0, 0}), 3 * 22 * 22);
  EXPECT_FLOAT_EQ(a.At({5, 10, 9}), 2 * 81 + 3 * 11 * 11);
  EXPECT_NEAR(a.At({10, 20, 30}), 2 * 900, 1e-2);
  EXPECT_EQ(Quadric().At({1e9F, 1e9F, 1e9F}), 0);
}

TEST(CostQueue, TakesTheCheapestButForAHundredthOfAnOctave) {
  std::mt19937_64 random(4);
  std::vector<float> cost(1000);
  for (float& value : cost) {
    value = std::ldexp(static_cast<float>(random() % 1000), static_cast<int>(random() % 200) - 100);
  }
  CostQueue queue(1000);
  for (uint32_t v = 0; v < 1000; ++v) queue.Push(v, 1);
  for (uint32_t v = 0; v < 1000; ++v) queue.Push(v, cost[v]);
  for (uint32_t v = 0; v < 1000; v += 10) queue.Remove(v);
  float before = 0;
  uint32_t taken = 0;
  for (uint32_t v = queue.Take(); v != CostQueue::kNobody; v = queue.Take()) {
    ASSERT_NE(v % 10, 0u);
    ASSERT_GE(cost[v] * 1.01F, before);
    ASSERT_LT(cost[v], queue.Limit());
    before = std::max(before, cost[v]);
    ++taken;
  }
  EXPECT_EQ(taken, 900u);
}

TEST(CostQueue, ACostBelowTheLastComesAtOnce) {
  CostQueue queue(3);
  queue.Push(0, 5);
  queue.Push(1, 100);
  EXPECT_EQ(queue.Take(), 0u);
  queue.Push(2, 1);
  queue.Push(0, std::numeric_limits<float>::infinity());
  EXPECT_EQ(queue.Take(), 2u);
  EXPECT_EQ(queue.Take(), 1u);
  EXPECT_EQ(queue.Take(), 0u);
  EXPECT_EQ(queue.Take(), CostQueue::kNobody);
}

TEST(CostQueue, PeeksOnlyAtWhatIsInItAndMostlyBeforeItIsTaken) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> cost(1, 4);
  constexpr uint32_t kVertices = 20'000;
  CostQueue queue(kVertices);
  for (uint32_t v = 0; v < kVertices; ++v) queue.Push(v, cost(random));
  std::vector<bool> is_in(kVertices, true), was_seen(kVertices, false);
  uint32_t taken = 0, seen_before = 0;
  for (uint32_t v = queue.Take(); v != CostQueue::kNobody; v = queue.Take()) {
    is_in[v] = false;
    ++taken;
    seen_before += was_seen[v] ? 1 : 0;
    const uint32_t peeked = queue.Peek();
    if (peeked != CostQueue::kNobody) {
      ASSERT_TRUE(is_in[peeked]);
      was_seen[peeked] = true;
    }
    const uint32_t other = random() % kVertices;
    if (taken % 3 == 0 && is_in[other]) queue.Push(other, 4 + cost(random));
  }
  EXPECT_EQ(taken, kVertices);
  EXPECT_GT(seen_before, kVertices / 2);
}

TEST(QuadricTree, IsSoundOnSheets) {
  for (uint32_t side : {2u, 3u, 10u, 41u}) {
    for (double height : {0.0, 4000.0}) {
      const Sheet sheet = GridSheet(side, height);
      ExpectSound(TreeOf(sheet), sheet.positions);
    }
  }
}

TEST(QuadricTree, InnerContractionsOfAFlatGridHaveNoError) {
  const Sheet sheet = GridSheet(21, 0);
  const SetTree tree = TreeOf(sheet);
  uint32_t without = 0;
  for (uint32_t i = 0; i < 2 * 21 * 21 - 1; ++i) {
    const SetTree::Node& node = tree.node(i);
    if (node.child_count == 0) continue;
    // Removed leaves inside the grid lie on all planes of their quadrics.
    const SetTree::Node& removed = tree.node(node.first_child + 1);
    if (removed.end - removed.begin > 1) continue;
    const Int3 p = removed.representative;
    if (p.x == 0 || p.y == 0 || p.x == 20000 || p.y == 20000) continue;
    // A distance that is the root of what rounding leaves, over about a million of area.
    EXPECT_LT(node.distortion, 1e3) << p.x << ' ' << p.y;
    ++without;
  }
  EXPECT_GT(without, 100u);
}

TEST(QuadricTree, KeepsAPeakLongerThanThePlaneAroundIt) {
  Sheet sheet = GridSheet(21, 0);
  const uint32_t peak = 10 * 21 + 10;
  sheet.positions[peak].z = 15000;
  const SetTree tree = TreeOf(sheet);
  // The split that brings the peak in is among the first twenty of the 440 by distortion.
  std::vector<double> distortions;
  double at_peak = tree.node(0).distortion;
  for (uint32_t i = 0; i < 2 * 21 * 21 - 1; ++i) {
    const SetTree::Node& node = tree.node(i);
    if (node.child_count == 0) continue;
    distortions.push_back(node.distortion);
    const Int3 added = tree.node(node.first_child + 1).representative;
    if (added == sheet.positions[peak]) at_peak = node.distortion;
  }
  const auto before =
      std::count_if(distortions.begin(), distortions.end(), [&](double d) { return d > at_peak; });
  EXPECT_LT(before, 20);
}

/// The six sides of a box of n x n cells each, inner vertices a little off the grid.
Sheet Box(uint32_t n) {
  constexpr int32_t kCell = 60;
  std::mt19937_64 random(3);
  std::map<std::array<uint32_t, 3>, uint32_t> known;
  Sheet box;
  const auto vertex = [&](std::array<uint32_t, 3> at) {
    const auto [place, is_new] = known.try_emplace(at, box.positions.size());
    if (!is_new) return place->second;
    std::array<int32_t, 3> p;
    const auto rims = std::count_if(at.begin(), at.end(), [&](uint32_t c) { return c % n == 0; });
    for (size_t i = 0; i < 3; ++i) {
      p[i] = static_cast<int32_t>(at[i]) * kCell;
      if (rims == 1 && at[i] % n != 0) p[i] += static_cast<int32_t>(random() % 31) - 15;
    }
    box.positions.push_back({p[0], p[1], p[2]});
    return place->second;
  };
  for (size_t axis = 0; axis < 3; ++axis) {
    for (uint32_t side : {0u, n}) {
      const auto at = [&](uint32_t i, uint32_t j) {
        std::array<uint32_t, 3> place;
        place[axis] = side;
        place[(axis + 1) % 3] = side == 0 ? j : i;
        place[(axis + 2) % 3] = side == 0 ? i : j;
        return vertex(place);
      };
      for (uint32_t i = 0; i < n; ++i) {
        for (uint32_t j = 0; j < n; ++j) {
          box.faces.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
          box.faces.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        }
      }
    }
  }
  return box;
}

TEST(QuadricTree, KeepsTheEdgesOfABoxWhateverLengthsWeigh) {
  constexpr uint32_t kCells = 16;
  const Sheet box = Box(kCells);
  const SetTree tree = TreeOf(box, 0.01);
  // The contractions that cost most join what is left of the edges; those within a side cost
  // nothing.
  std::vector<std::pair<double, Int3>> splits;
  for (uint32_t i = 0; i < 2 * box.positions.size() - 1; ++i) {
    const SetTree::Node& node = tree.node(i);
    if (node.child_count > 0) {
      splits.push_back({node.distortion, tree.node(node.first_child + 1).representative});
    }
  }
  std::stable_sort(splits.begin(), splits.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  uint32_t corners = 0;
  for (size_t i = 0; i < 7; ++i) {
    const Int3& p = splits[i].second;
    const auto at_end = [](int32_t c) { return c == 0 || c == 60 * static_cast<int32_t>(kCells); };
    corners += at_end(p.x) && at_end(p.y) && at_end(p.z) ? 1 : 0;
  }
  EXPECT_EQ(corners, 7u) << "all eight corners, one of which is the root";
}

TEST(QuadricTree, OneVertexIsOneNode) {
  const Sheet sheet{{{7, 8, 9}}, {}};
  ExpectSound(TreeOf(sheet), sheet.positions);
}

TEST(QuadricTree, IsolatedVerticesAreJoinedWithTheirNeighbours) {
  std::mt19937_64 random(1);
  Sheet sheet;
  for (int i = 0; i < 1001; ++i) {
    auto draw = [&] { return static_cast<int32_t>(random() % (1 << 30)); };
    sheet.positions.push_back({draw(), draw(), draw()});
  }
  ExpectSound(TreeOf(sheet), sheet.positions);
  // Two clouds far apart are the two children.
  for (size_t i = 0; i < 1000; ++i) {
    const int32_t base = i % 2 == 0 ? 0 : 1 << 29;
    for (int32_t* c : {&sheet.positions[i].x, &sheet.positions[i].y, &sheet.positions[i].z}) {
      *c = base + *c % 1000000;
    }
  }
  sheet.positions.pop_back();
  sheet.positions.resize(512);
  const SetTree tree = TreeOf(sheet);
  ExpectSound(tree, sheet.positions);
  const auto half = tree.VerticesOf(tree.node(0).first_child);
  EXPECT_EQ(half.size(), 256u);
  for (uint32_t v : half) EXPECT_EQ(v % 2, half[0] % 2);
}

TEST(QuadricTree, CoincidentVerticesAreFine) {
  Sheet sheet = GridSheet(12, 3000);
  for (Int3& p : sheet.positions) p = {p.x / 4000 * 4000, p.y / 4000 * 4000, 5};
  ExpectSound(TreeOf(sheet), sheet.positions);
  for (Int3& p : sheet.positions) p = {5, 5, 5};
  ExpectSound(TreeOf(sheet), sheet.positions);
  sheet.faces.clear();
  ExpectSound(TreeOf(sheet), sheet.positions);
}

TEST(QuadricTree, DuplicateAndDegenerateFacesAreFine) {
  Sheet sheet = GridSheet(8, 3000);
  const std::vector<Face> once = sheet.faces;
  for (const Face& f : once) {
    sheet.faces.push_back(f);
    sheet.faces.push_back({f[0], f[2], f[1]});
    sheet.faces.push_back({f[0], f[0], f[1]});
    sheet.faces.push_back({f[0], f[1], f[0]});
    sheet.faces.push_back({f[0], f[1], f[1]});
    sheet.faces.push_back({f[2], f[2], f[2]});
  }
  ExpectSound(TreeOf(sheet), sheet.positions);
}

TEST(QuadricTree, DegenerateFacesJoinTheirCornersInEveryOrder) {
  // Two far vertices with an edge and a third one near the first: the edge is what counts.
  const std::vector<Int3> positions{{0, 0, 0}, {100, 100000000, 0}, {200, 0, 0}};
  for (const Face& face : {Face{0, 0, 1}, Face{0, 1, 0}, Face{1, 0, 0}}) {
    const Sheet sheet{positions, {face}};
    const SetTree tree = TreeOf(sheet);
    ExpectSound(tree, positions);
    uint32_t pairs = 0;
    for (uint32_t child : {1u, 2u}) {
      if (tree.VerticesOf(child).size() != 2) continue;
      ++pairs;
      EXPECT_NE(tree.VerticesOf(child)[0], 2u);
      EXPECT_NE(tree.VerticesOf(child)[1], 2u);
      // Both ends know the edge, so the first of equals goes first.
      EXPECT_EQ(tree.node(child).representative, positions[1]);
    }
    EXPECT_EQ(pairs, 1u);
  }
}

/// Spokes around a hub: a disc, and spokes in random places.
Sheet Hub(uint32_t spokes, bool disc) {
  std::mt19937_64 random(3);
  Sheet sheet;
  sheet.positions.push_back({500000000, 500000000, 500000000});
  for (uint32_t i = 0; i < spokes; ++i) {
    const double angle = 6.283185307 * i / spokes;
    auto draw = [&] { return static_cast<int32_t>(random() % (1 << 30)); };
    const Int3 rim{static_cast<int32_t>(5e8 + 4e8 * std::cos(angle)),
                   static_cast<int32_t>(5e8 + 4e8 * std::sin(angle)), 500000000};
    sheet.positions.push_back(disc ? rim : Int3{draw(), draw(), draw()});
    sheet.faces.push_back({0, i + 1, (i + 1) % spokes + 1});
  }
  return sheet;
}

TEST(QuadricTree, HubWithManySpokesIsNoTrouble) {
  for (bool disc : {true, false}) {
    const Sheet sheet = Hub(20000, disc);
    ExpectSound(TreeOf(sheet), sheet.positions);
  }
}

TEST(QuadricTree, EndsWithAnyLengthWeight) {
  const Sheet flat = GridSheet(12, 0);
  const Sheet wavy = GridSheet(12, 4000);
  for (double weight : {0.0, 1e-300, 1e-45, 1e-30, 0.03, 10.0}) {
    ExpectSound(TreeOf(flat, weight), flat.positions);
    ExpectSound(TreeOf(wavy, weight), wavy.positions);
  }
}

TEST(QuadricTree, SoupOfRandomFacesInTheLargestBoxIsSound) {
  std::mt19937_64 random(5);
  Sheet sheet;
  for (int i = 0; i < 500; ++i) {
    auto draw = [&] { return static_cast<int32_t>(random() % (1 << 30)); };
    sheet.positions.push_back({draw(), draw(), draw()});
  }
  for (int i = 0; i < 2000; ++i) {
    auto draw = [&] { return static_cast<uint32_t>(random() % 500); };
    sheet.faces.push_back({draw(), draw(), draw()});
  }
  ExpectSound(TreeOf(sheet, 10), sheet.positions);
}

TEST(QuadricTree, CrossFacesLendTheirPlanes) {
  // One own vertex per cross face, none joined by an edge, and one edge of two.
  const std::vector<Int3> positions{{0, 0, 0}, {1000, 0, 0}, {5000, 5000, 10}};
  std::vector<CrossFace> cross(2);
  cross[0].vertex = {VertexRef{3, 0}, VertexRef{3, 1}, VertexRef{4, 0}};
  cross[0].position = {positions[0], positions[1], Int3{0, 1000, 500}};
  cross[1].vertex = {VertexRef{1, 7}, VertexRef{3, 2}, VertexRef{4, 2}};
  cross[1].position = {Int3{1, 2, 3}, positions[2], Int3{9000, 0, 4}};
  const SetTree tree = BuildQuadricTree(positions, {}, cross, 3, CodecSettings());
  ExpectSound(tree, positions);
  bool joined = false;
  for (uint32_t child = 1; child <= 2; ++child) joined |= tree.VerticesOf(child).size() == 2;
  EXPECT_TRUE(joined);
}

TEST(QuadricTree, IsTheSameEachTime) {
  for (double height : {0.0, 4000.0}) {
    const Sheet sheet = GridSheet(30, height);
    ExpectEqualTrees(TreeOf(sheet), TreeOf(sheet));
  }
}

}  // namespace
}  // namespace folprom
