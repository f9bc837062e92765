#include "tests/bench/peers/fidelity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <utility>

namespace folprom::peers {
namespace {

constexpr double kTolerance = 0.01;

// A square of n x n vertices in the plane, `distance` apart.
Mesh Square(uint32_t n, double distance) {
  Mesh mesh;
  for (uint32_t y = 0; y < n; ++y) {
    for (uint32_t x = 0; x < n; ++x) mesh.positions.push_back({x * distance, y * distance, 0});
  }
  for (uint32_t y = 0; y + 1 < n; ++y) {
    for (uint32_t x = 0; x + 1 < n; ++x) {
      const uint32_t v = y * n + x;
      mesh.faces.push_back({v, v + 1, v + n});
      mesh.faces.push_back({v + 1, v + n + 1, v + n});
    }
  }
  return mesh;
}

// Vertices and faces in another order, faces rotated.
Mesh Shuffled(const Mesh& mesh) {
  std::mt19937 random(7);
  std::vector<uint32_t> place(mesh.positions.size());
  std::iota(place.begin(), place.end(), 0U);
  std::shuffle(place.begin(), place.end(), random);
  Mesh shuffled;
  shuffled.positions.resize(place.size());
  for (size_t v = 0; v < place.size(); ++v) shuffled.positions[place[v]] = mesh.positions[v];
  for (const Triple& f : mesh.faces) {
    shuffled.faces.push_back({place[f[1]], place[f[2]], place[f[0]]});
  }
  std::shuffle(shuffled.faces.begin(), shuffled.faces.end(), random);
  return shuffled;
}

TEST(Fidelity, SameMeshKeepsAll) {
  const Mesh mesh = Square(9, 1);
  const Fidelity fidelity = CompareWithOriginal(mesh, mesh, kTolerance);
  EXPECT_TRUE(fidelity.same_connectivity());
  EXPECT_TRUE(fidelity.vertex_order);
  EXPECT_TRUE(fidelity.face_order);
}

TEST(Fidelity, TellsAnotherOrderFromAnotherMesh) {
  const Mesh mesh = Square(9, 1);
  const Fidelity fidelity = CompareWithOriginal(mesh, Shuffled(mesh), kTolerance);
  EXPECT_TRUE(fidelity.same_connectivity());
  EXPECT_FALSE(fidelity.vertex_order);
  EXPECT_FALSE(fidelity.face_order);
}

TEST(Fidelity, PairsVerticesCloserThanTheToleranceByTheirFaces) {
  Mesh mesh = Square(40, 1);
  // A patch so small that positions alone say nothing inside.
  for (Point& p : mesh.positions) {
    if (p[0] > 10 && p[0] < 20 && p[1] > 10 && p[1] < 20) {
      p = {15 + p[0] * 1e-5, 15 + p[1] * 1e-5, 0};
    }
  }
  EXPECT_TRUE(CompareWithOriginal(mesh, Shuffled(mesh), kTolerance).same_connectivity());
}

TEST(Fidelity, PairsCoincidentVerticesByTheirFaces) {
  Mesh mesh = Square(9, 1);
  // A second square begins on the line where the first one ends, with vertices of its own, and a
  // third one covers the first.
  for (const double shift : {8.0, 0.0}) {
    const auto base = static_cast<uint32_t>(mesh.positions.size());
    for (const Point& p : Square(9, 1).positions) mesh.positions.push_back({p[0] + shift, p[1], 0});
    for (const Triple& f : Square(9, 1).faces) {
      mesh.faces.push_back({f[0] + base, f[1] + base, f[2] + base});
    }
  }
  EXPECT_TRUE(CompareWithOriginal(mesh, Shuffled(mesh), kTolerance).same_connectivity());
}

TEST(Fidelity, PairsCoincidentIsolatedVertices) {
  Mesh mesh = Square(4, 1);
  for (int i = 0; i < 3; ++i) mesh.positions.push_back({9, 9, 9});
  EXPECT_TRUE(CompareWithOriginal(mesh, Shuffled(mesh), kTolerance).same_connectivity());
}

TEST(Fidelity, CountsAMergedVertexAsLost) {
  Mesh mesh = Square(4, 1);
  mesh.positions.push_back(mesh.positions[0]);
  mesh.faces.push_back({1, 2, 16});
  Mesh merged = mesh;
  merged.positions.pop_back();
  merged.faces.back()[2] = 0;
  const Fidelity fidelity = CompareWithOriginal(mesh, merged, kTolerance);
  EXPECT_FALSE(fidelity.same_vertices());
  EXPECT_EQ(fidelity.lost.vertices, 1U);
  EXPECT_EQ(fidelity.lost.faces, 1U);
}

TEST(Fidelity, CountsAnIsolatedVertexThatIsGone) {
  Mesh mesh = Square(4, 1);
  const Mesh decoded = Shuffled(mesh);
  mesh.positions.push_back({50, 50, 50});
  const Fidelity fidelity = CompareWithOriginal(mesh, decoded, kTolerance);
  EXPECT_FALSE(fidelity.same_vertices());
  EXPECT_EQ(fidelity.lost.vertices, 1U);
  EXPECT_EQ(fidelity.lost.faces, 0U);
}

TEST(Fidelity, SeesAReversedFace) {
  const Mesh mesh = Square(9, 1);
  Mesh reversed = Shuffled(mesh);
  std::swap(reversed.faces[5][0], reversed.faces[5][1]);
  const Fidelity fidelity = CompareWithOriginal(mesh, reversed, kTolerance);
  EXPECT_TRUE(fidelity.same_vertices());
  EXPECT_EQ(fidelity.lost.faces, 1U);
  EXPECT_FALSE(fidelity.same_connectivity());
}

TEST(Fidelity, SeesADuplicateFaceThatIsGone) {
  const Mesh decoded = Square(4, 1);
  Mesh mesh = decoded;
  mesh.faces.push_back(mesh.faces[3]);
  const Fidelity fidelity = CompareWithOriginal(mesh, decoded, kTolerance);
  EXPECT_EQ(fidelity.lost.faces, 1U);
  EXPECT_FALSE(fidelity.same_connectivity());
  // Nor is one too many the same.
  EXPECT_FALSE(CompareWithOriginal(decoded, mesh, kTolerance).same_connectivity());
}

TEST(Fidelity, HoldsPositionsToTheTolerance) {
  const Mesh mesh = Square(9, 1);
  Mesh moved = mesh;
  for (Point& p : moved.positions) p[2] += 0.9 * kTolerance;
  EXPECT_TRUE(CompareWithOriginal(mesh, moved, kTolerance).same_connectivity());
  moved.positions[7][2] += 0.2 * kTolerance;
  const Fidelity fidelity = CompareWithOriginal(mesh, moved, kTolerance);
  EXPECT_FALSE(fidelity.vertex_order);
  EXPECT_EQ(fidelity.lost.vertices, 1U);
}

}  // namespace
}  // namespace folprom::peers
