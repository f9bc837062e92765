#include "engine/connectivity/complex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace folprom {
namespace {

/// The same operations on plain lists, in the order that the Complex promises.
class NaiveComplex {
 public:
  void AddVertex() {
    half_edges_.emplace_back();
    corners_.emplace_back();
  }
  void AddEdge(uint32_t a, uint32_t b) {
    const uint32_t edge = static_cast<uint32_t>(start_.size() / 2);
    start_.insert(start_.end(), {a, b});
    AddLast(half_edges_[a], 2 * edge);
    AddLast(half_edges_[b], 2 * edge + 1);
  }
  void AddFace(uint32_t a, uint32_t b, uint32_t c) {
    for (uint32_t vertex : {a, b, c}) {
      AddLast(corners_[vertex], static_cast<uint32_t>(corner_vertex_.size()));
      corner_vertex_.push_back(vertex);
    }
  }
  void MoveHalfEdge(uint32_t half_edge, uint32_t to) {
    Remove(half_edges_[start_[half_edge]], half_edge);
    start_[half_edge] = to;
    AddLast(half_edges_[to], half_edge);
  }
  void MoveCorner(uint32_t corner, uint32_t to) {
    Remove(corners_[corner_vertex_[corner]], corner);
    corner_vertex_[corner] = to;
    AddLast(corners_[to], corner);
  }

  void ExpectSame(const Complex& complex) const {
    ASSERT_EQ(complex.vertex_count(), half_edges_.size());
    ASSERT_EQ(complex.edge_count() * 2, start_.size());
    ASSERT_EQ(complex.face_count() * 3, corner_vertex_.size());
    for (uint32_t v = 0; v < half_edges_.size(); ++v) {
      std::vector<uint32_t> found;
      for (const auto& [target, half_edge] : complex.Spokes(v)) {
        found.push_back(half_edge);
        ASSERT_EQ(target, start_[half_edge ^ 1]);
      }
      ASSERT_EQ(found, half_edges_[v]);
      found.clear();
      for (const uint32_t corner : complex.Corners(v)) {
        found.push_back(corner);
        ASSERT_EQ(complex.VertexOf(corner), v);
      }
      ASSERT_EQ(found, corners_[v]);
    }
    for (uint32_t e = 0; e < complex.edge_count(); ++e) {
      ASSERT_EQ(complex.edge(e), (std::array<uint32_t, 2>{start_[2 * e], start_[2 * e + 1]}));
    }
    for (uint32_t f = 0; f < complex.face_count(); ++f) {
      ASSERT_EQ(complex.face(f), (Face{corner_vertex_[3 * f], corner_vertex_[3 * f + 1],
                                       corner_vertex_[3 * f + 2]}));
    }
  }
  uint32_t start(uint32_t half_edge) const { return start_[half_edge]; }
  uint32_t vertex_of(uint32_t corner) const { return corner_vertex_[corner]; }

 private:
  static void AddLast(std::vector<uint32_t>& list, uint32_t value) {
    list.push_back(value);
  }
  /// The last takes its place.
  static void Remove(std::vector<uint32_t>& list, uint32_t value) {
    *std::find(list.begin(), list.end(), value) = list.back();
    list.pop_back();
  }
  std::vector<std::vector<uint32_t>> half_edges_, corners_;
  std::vector<uint32_t> start_, corner_vertex_;
};

TEST(Complex, DoesWhatPlainListsDo) {
  for (uint64_t seed = 0; seed < 30; ++seed) {
    std::mt19937_64 random(seed);
    Complex complex;
    NaiveComplex naive;
    for (int step = 0; step < 400; ++step) {
      const uint32_t vertices = complex.vertex_count();
      auto vertex = [&] { return static_cast<uint32_t>(random() % vertices); };
      const uint64_t kind = vertices < 4 ? 0 : random() % 5;
      if (kind == 0) {
        EXPECT_EQ(complex.AddVertex(), vertices);
        naive.AddVertex();
      } else if (kind == 1) {
        const uint32_t a = vertex();
        const uint32_t b = (a + 1 + static_cast<uint32_t>(random() % (vertices - 1))) % vertices;
        const uint32_t added = complex.AddEdge(a, b);
        EXPECT_EQ(added, complex.edge_count() - 1);
        naive.AddEdge(a, b);
      } else if (kind == 2) {
        const uint32_t a = vertex();
        const uint32_t added = complex.AddFace(a, (a + 1) % vertices, (a + 2) % vertices);
        EXPECT_EQ(added, complex.face_count() - 1);
        naive.AddFace(a, (a + 1) % vertices, (a + 2) % vertices);
      } else if (kind == 3 && complex.edge_count() > 0) {
        const uint32_t half_edge = static_cast<uint32_t>(random() % (2 * complex.edge_count()));
        const uint32_t to = vertex();
        complex.MoveHalfEdge(half_edge, naive.start(half_edge), to);
        naive.MoveHalfEdge(half_edge, to);
      } else if (kind == 4 && complex.face_count() > 0) {
        const uint32_t corner = static_cast<uint32_t>(random() % (3 * complex.face_count()));
        const uint32_t to = vertex();
        complex.MoveCorner(corner, naive.vertex_of(corner), to);
        naive.MoveCorner(corner, to);
      }
    }
    ASSERT_NO_FATAL_FAILURE(naive.ExpectSame(complex)) << seed;
  }
}

TEST(Complex, TellsTheOtherCornersInTheOrderOfTheFace) {
  Complex complex;
  for (int i = 0; i < 5; ++i) complex.AddVertex();
  complex.AddFace(0, 1, 2);
  complex.AddFace(4, 3, 1);
  using Two = std::array<uint32_t, 2>;
  EXPECT_EQ(complex.Opposite(3), (Two{3, 1}));
  EXPECT_EQ(complex.Opposite(4), (Two{1, 4}));
  EXPECT_EQ(complex.Opposite(5), (Two{4, 3}));
}

TEST(Complex, AHubKeepsItsSpokes) {
  Complex complex;
  constexpr uint32_t kRim = 1000;
  for (uint32_t i = 0; i <= kRim; ++i) complex.AddVertex();
  for (uint32_t i = 1; i <= kRim; ++i) complex.AddEdge(0, i);
  EXPECT_EQ(complex.Degree(0), kRim);
  const uint32_t other = complex.AddVertex();
  for (uint32_t e = 0; e < kRim; e += 2) complex.MoveHalfEdge(2 * e, 0, other);
  EXPECT_EQ(complex.Degree(0), kRim / 2);
  EXPECT_EQ(complex.Degree(other), kRim / 2);
  for (uint32_t i = 1; i <= kRim; ++i) {
    ASSERT_EQ(complex.Degree(i), 1u);
    EXPECT_EQ(complex.Spokes(i)[0].target, i % 2 == 1 ? other : 0);
  }
}

TEST(Complex, CornersFollowEachOtherAroundTheirFace) {
  for (uint32_t corner = 0; corner < 30; ++corner) {
    EXPECT_EQ(NextCorner(corner) / 3, corner / 3);
    EXPECT_EQ(PreviousCorner(NextCorner(corner)), corner);
    EXPECT_EQ(NextCorner(NextCorner(NextCorner(corner))), corner);
    EXPECT_NE(NextCorner(corner), corner);
  }
}

TEST(BlockLists, DoWhatPlainListsDo) {
  std::mt19937_64 random(6);
  BlockLists<uint32_t> lists;
  std::vector<std::vector<uint32_t>> plain(20);
  for (size_t i = 0; i < plain.size(); ++i) lists.AddList();
  for (uint32_t step = 0; step < 20000; ++step) {
    const uint32_t list = static_cast<uint32_t>(random() % plain.size());
    const uint32_t other = (list + 1) % static_cast<uint32_t>(plain.size());
    std::vector<uint32_t>&one = plain[list], &two = plain[other];
    const uint64_t kind = random() % 100;
    if (kind < 70) {
      EXPECT_EQ(lists.Append(list, step), one.size());
      one.push_back(step);
    } else if (kind < 90 && !one.empty()) {
      const size_t place = random() % one.size();
      lists.Remove(list, static_cast<uint32_t>(place));
      one[place] = one.back();
      one.pop_back();
    } else if (kind < 95) {
      lists.Swap(list, other);
      one.swap(two);
    } else if (kind < 97) {
      lists.MoveAll(list, other);
      two.insert(two.end(), one.begin(), one.end());
      one.clear();
    } else {
      lists.Shrink(list, static_cast<uint32_t>(one.size() / 2));
      one.resize(one.size() / 2);
    }
  }
  for (uint32_t list = 0; list < plain.size(); ++list) {
    const auto values = lists.Of(list);
    EXPECT_EQ(std::vector<uint32_t>(values.begin(), values.end()), plain[list]);
    EXPECT_EQ(lists.SizeOf(list), plain[list].size());
  }
}

}  // namespace
}  // namespace folprom
