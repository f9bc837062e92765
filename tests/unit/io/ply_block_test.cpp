#include <gtest/gtest.h>

#include <thread>

#include "ply_builder.h"
#include "support.h"

namespace folprom::io {
namespace {

using enum ScalarType;
using testing::AllBlocks;
using testing::kAllFormats;
using testing::OpenBytes;
using testing::PlyBuilder;
using testing::TemporaryFolder;

constexpr uint64_t kVertices = 200000;

// Many vertices, with a list in each where they shall be of many sizes, then the lists given.
std::string LargeFile(PlyFormat format, bool vertex_lists, const std::string& element,
                      const std::vector<std::vector<double>>& lists) {
  PlyBuilder ply(format);
  ply.Header("element vertex " + std::to_string(kVertices)).Header("property float x");
  if (vertex_lists) ply.Header("property list uchar uchar tags");
  ply.Header("property int y").Header("property float z");
  ply.Header("element " + element + " " + std::to_string(lists.size()));
  ply.Header("property list int int vertex_indices").Header("property uchar last").Body();
  for (uint64_t v = 0; v < kVertices; ++v) {
    ply.Value(kFloat32, double(v));
    if (vertex_lists) ply.List(kUint8, kUint8, std::vector<double>(v % 3, 1));
    ply.Value(kInt32, double(v / 2)).Value(kFloat32, 0.5).End();
  }
  for (const auto& list : lists) ply.List(kInt32, kInt32, list).Value(kUint8, 1).End();
  return ply.bytes();
}

void ExpectPositions(const std::vector<double>& xyz) {
  ASSERT_EQ(xyz.size(), 3 * kVertices);
  for (uint64_t v = 0; v < kVertices; ++v) {
    ASSERT_EQ(xyz[3 * v], double(v));
    ASSERT_EQ(xyz[3 * v + 1], double(v / 2));
    ASSERT_EQ(xyz[3 * v + 2], 0.5);
  }
}

TEST(PlyBlocks, GiveAllVerticesOfFixedAndVariableSize) {
  for (const PlyFormat format : kAllFormats) {
    for (const bool lists : {false, true}) {
      const TemporaryFolder folder;
      const auto source = OpenBytes(folder, LargeFile(format, lists, "face", {})).value();
      EXPECT_EQ(source->vertex_block_count(), 4u);
      ExpectPositions(AllBlocks(*source).value().xyz);
    }
  }
}

TEST(PlyBlocks, GiveTheTrianglesOfManyFacesAndPolygonsInOrder) {
  std::vector<std::vector<double>> faces;
  std::vector<Triangle> expected;
  for (uint64_t f = 0; f < 130000; ++f) {
    const uint64_t a = f, b = f + 1, c = kVertices - 1 - f, d = f / 2;
    if (f % 5 == 0) {
      faces.push_back({double(a), double(b), double(c), double(d)});
      expected.insert(expected.end(), {{a, b, c}, {a, c, d}});
    } else if (f % 11 == 0) {
      faces.push_back({double(a)});
    } else {
      faces.push_back({double(a), double(b), double(c)});
      expected.push_back({a, b, c});
    }
  }
  for (const PlyFormat format : kAllFormats) {
    const TemporaryFolder folder;
    const auto source = OpenBytes(folder, LargeFile(format, false, "face", faces)).value();
    EXPECT_LE(source->triangle_block_count(), 4u);
    EXPECT_EQ(AllBlocks(*source).value().triangles, expected);
  }
}

TEST(PlyBlocks, CutAHugePolygon) {
  std::vector<double> corners(kVertices);
  for (uint64_t v = 0; v < kVertices; ++v) corners[v] = double(kVertices - 1 - v);
  for (const PlyFormat format : kAllFormats) {
    const TemporaryFolder folder;
    const auto source =
        OpenBytes(folder, LargeFile(format, false, "face", {{0, 1, 2}, corners, {3, 4, 5}}))
            .value();
    const std::vector<Triangle> triangles = AllBlocks(*source).value().triangles;
    ASSERT_EQ(triangles.size(), kVertices);
    EXPECT_EQ(triangles.front(), (Triangle{0, 1, 2}));
    EXPECT_EQ(triangles.back(), (Triangle{3, 4, 5}));
    for (uint64_t t = 1; t + 1 < triangles.size(); ++t) {
      ASSERT_EQ(triangles[t], (Triangle{kVertices - 1, kVertices - 1 - t, kVertices - 2 - t}));
    }
  }
}

TEST(PlyBlocks, CutALongStripAnywhere) {
  std::vector<double> strip;
  std::vector<Triangle> expected;
  // Stitches and restarts at odd distances, so that blocks begin at every kind of place.
  std::vector<uint64_t> run;
  uint64_t next = 0;
  for (uint64_t i = 0; i < 300000; ++i) {
    if (i % 70001 == 70000) {
      strip.push_back(-1);
      run.clear();
      continue;
    }
    const uint64_t vertex = i % 13 == 5 && !run.empty() ? run.back() : next++ % kVertices;
    strip.push_back(double(vertex));
    run.push_back(vertex);
    const size_t n = run.size();
    if (n < 3) continue;
    Triangle t = {run[n - 3], run[n - 2], run[n - 1]};
    if (n % 2 == 0) std::swap(t[0], t[1]);
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) expected.push_back(t);
  }
  for (const PlyFormat format : kAllFormats) {
    const TemporaryFolder folder;
    const auto source =
        OpenBytes(folder, LargeFile(format, true, "tristrips", {strip, {7, 8, 9}})).value();
    std::vector<Triangle> all = expected;
    all.push_back({7, 8, 9});
    EXPECT_GE(source->triangle_block_count(), 3u);
    EXPECT_EQ(AllBlocks(*source).value().triangles, all);
    EXPECT_EQ(source->notes().strips, 6u);
  }
}

TEST(PlyBlocks, AreReadFromSeveralThreadsAtOnce) {
  std::vector<std::vector<double>> faces;
  for (uint64_t f = 0; f < kVertices - 2; ++f) {
    faces.push_back({double(f), double(f + 1), double(f + 2)});
  }
  for (const PlyFormat format : {PlyFormat::kAscii, PlyFormat::kBinaryBigEndian}) {
    const TemporaryFolder folder;
    const auto source = OpenBytes(folder, LargeFile(format, true, "face", faces)).value();
    std::vector<std::thread> threads;
    std::vector<testing::Mesh> meshes(3);
    for (testing::Mesh& mesh : meshes) {
      threads.emplace_back([&] { mesh = AllBlocks(*source).value(); });
    }
    for (std::thread& thread : threads) thread.join();
    for (const testing::Mesh& mesh : meshes) {
      ExpectPositions(mesh.xyz);
      ASSERT_EQ(mesh.triangles.size(), faces.size());
      EXPECT_EQ(mesh.triangles, meshes[0].triangles);
    }
  }
}

}  // namespace
}  // namespace folprom::io
