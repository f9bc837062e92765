// `--keep-order`: the arrays of the decoded file are those of the scan, element by element.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "parallel/runner.h"
#include "tests/order/plain_mesh.h"
#include "tests/support/codec.h"
#include "tests/support/files.h"
#include "tests/support/meshes.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace folprom::support {
namespace {

EncodeOptions ExactInOrder(uint32_t subtree_vertices) {
  EncodeOptions options;
  options.exact = true;
  options.keep_order = true;
  options.codec.subtree_vertices = subtree_vertices;
  return options;
}

void ExpectSameArrays(const PlainMesh& decoded, const PlainMesh& scan) {
  EXPECT_TRUE(decoded.vertices == scan.vertices);
  EXPECT_TRUE(decoded.faces == scan.faces);
}

void ExpectArraysBack(const std::string& scan, EncodeOptions options) {
  const TemporaryFolder folder;
  Encode(scan, folder.File("scan.folp"), options);
  const DecodeReport report = Decode(folder.File("scan.folp"), folder.File("back.ply"));
  EXPECT_TRUE(report.complete);
  ExpectSameArrays(ReadPlain(folder.File("back.ply")), ReadPlain(scan));
  const VerifyReport verified = Verify(folder.File("scan.folp"), scan);
  EXPECT_TRUE(verified.lossless) << verified.reason;
  EXPECT_TRUE(verified.order_kept);
}

/// The same where the output has the format of the scan, as far as that is not PLY.
void ExpectArraysBackInItsFormat(const std::string& scan) {
  const std::string ending = std::filesystem::path(scan).extension().string();
  if (ending == ".ply") return;
  const TemporaryFolder folder;
  Encode(scan, folder.File("scan.folp"), ExactInOrder(20'000));
  Decode(folder.File("scan.folp"), folder.File("back" + ending));
  ExpectSameArrays(ReadPlain(folder.File("back" + ending)), ReadPlain(scan));
}

/// Calls expect(path) for each hard file; skips the test where there are none.
template <class Expect>
void ForEachHardFile(Expect expect) {
  if (SharedFile("hard/truck.ply").empty()) GTEST_SKIP() << kNoSharedData;
  const auto folder = std::filesystem::path(SharedFile("hard/truck.ply")).parent_path();
  for (const std::string& name : NamesIn(folder)) {
    const std::string path = (folder / name).string();
    if (kSanitized && std::filesystem::file_size(path) > 800'000) continue;
    SCOPED_TRACE(name);
    expect(path);
  }
}

TEST(Order, GivesTheArraysOfHardFilesBackInTheirOwnFormat) {
  ForEachHardFile(ExpectArraysBackInItsFormat);
}

TEST(Order, GivesTheArraysOfHardFilesBack) {
  ForEachHardFile([](const std::string& path) { ExpectArraysBack(path, ExactInOrder(20'000)); });
}

TEST(Order, GivesTheArraysOfSmallMeshesBack) {
  for (const SmallMesh& mesh : SmallMeshes()) {
    SCOPED_TRACE(mesh.name);
    const TemporaryFolder folder;
    WritePly(folder.File("scan.ply"), mesh.make(), CoordinateType::kFloat);
    ExpectArraysBack(folder.File("scan.ply"), ExactInOrder(100));
  }
}

TEST(Order, IsKeptWhereCoordinatesAreRounded) {
  const TemporaryFolder folder;
  const Mesh mesh = NonManifoldSoup(500, 900, 7);
  WritePly(folder.File("scan.ply"), mesh, CoordinateType::kDouble);
  EncodeOptions options = ExactInOrder(100);
  options.exact = false;
  options.bits = 12;
  Encode(folder.File("scan.ply"), folder.File("scan.folp"), options);
  Decode(folder.File("scan.folp"), folder.File("back.ply"));
  const PlyContent back = ReadPly(folder.File("back.ply"));
  EXPECT_EQ(back.mesh.faces, mesh.faces);
  const VerifyReport verified = Verify(folder.File("scan.folp"), folder.File("scan.ply"));
  EXPECT_TRUE(verified.lossless) << verified.reason;
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    for (size_t axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(back.mesh.positions[v][axis], mesh.positions[v][axis], verified.tolerance);
    }
  }
}

TEST(Order, IsTheSameFromMemory) {
  const TemporaryFolder folder;
  WritePly(folder.File("scan.ply"), NonManifoldSoup(500, 900, 8), CoordinateType::kFloat);
  Encode(folder.File("scan.ply"), folder.File("scan.folp"), ExactInOrder(100));
  EXPECT_TRUE(Verify(folder.File("scan.folp"), "").lossless);
  const Mesh mesh = LodOf(folder.File("scan.folp"));
  EXPECT_TRUE(mesh.has_scan_order);
  EXPECT_TRUE(mesh.polygon_begin.empty());
  const Mesh scan = ReadPly(folder.File("scan.ply")).mesh;
  EXPECT_EQ(mesh.positions, scan.positions);
  EXPECT_EQ(mesh.faces, scan.faces);
  EXPECT_FALSE(LodOf(folder.File("scan.folp"), 1).has_scan_order);
}

TEST(Order, HasTheSameBytesForAnyThreadsAndMemory) {
  const TemporaryFolder folder;
  WritePly(folder.File("scan.ply"), NonManifoldSoup(3000, 5000, 9), CoordinateType::kFloat);
  Encode(folder.File("scan.ply"), folder.File("1.folp"), ExactInOrder(200));
  const auto tbb = parallel::MakeTbbRunner(3);
  const auto shuffled = parallel::MakeShuffledRunner(4);
  EncodeOptions little = ExactInOrder(200);
  little.limits.memory_bytes = uint64_t{1} << 20;
  Encode(folder.File("scan.ply"), folder.File("2.folp"), little, tbb.get());
  Encode(folder.File("scan.ply"), folder.File("3.folp"), ExactInOrder(200), shuffled.get());
  EXPECT_TRUE(FileBytes(folder.File("1.folp")) == FileBytes(folder.File("2.folp")));
  EXPECT_TRUE(FileBytes(folder.File("1.folp")) == FileBytes(folder.File("3.folp")));
  DecodeOptions options;
  options.limits.memory_bytes = uint64_t{1} << 20;
  Decode(folder.File("1.folp"), folder.File("1.ply"));
  Decode(folder.File("1.folp"), folder.File("2.ply"), options, tbb.get());
  EXPECT_TRUE(FileBytes(folder.File("1.ply")) == FileBytes(folder.File("2.ply")));
}

/// side x side vertices row by row, two triangles a square.
Mesh Grid(uint64_t side) {
  Mesh mesh;
  for (uint64_t y = 0; y < side; ++y) {
    for (uint64_t x = 0; x < side; ++x) {
      const double u = static_cast<double>(x), v = static_cast<double>(y);
      mesh.positions.push_back({u, v, std::floor(std::sqrt(u * v))});
      if (x + 1 == side || y + 1 == side) continue;
      const uint64_t a = y * side + x;
      mesh.faces.push_back({a, a + 1, a + side});
      mesh.faces.push_back({a + side, a + 1, a + side + 1});
    }
  }
  return mesh;
}

TEST(Order, OfAGridTakesFewBits) {
  const TemporaryFolder folder;
  WritePly(folder.File("scan.ply"), Grid(100), CoordinateType::kFloat);
  const EncodeReport report =
      Encode(folder.File("scan.ply"), folder.File("scan.folp"), ExactInOrder(4000));
  // Of 11.8 bits a vertex and 12.8 a face that any order at all would take.
  EXPECT_LT(8 * report.order_bytes, report.vertices);
}

TEST(Order, CostsNoMoreThanAListOfNumbers) {
  const TemporaryFolder folder;
  Mesh mesh = Grid(40);
  Random random(3);
  for (size_t i = mesh.faces.size(); i > 1; --i) {
    std::swap(mesh.faces[i - 1], mesh.faces[random.Below(i)]);
  }
  WritePly(folder.File("scan.ply"), mesh, CoordinateType::kFloat);
  const EncodeReport report =
      Encode(folder.File("scan.ply"), folder.File("scan.folp"), ExactInOrder(4000));
  EXPECT_LT(8 * report.order_bytes, 13 * (report.vertices + report.faces));
}

TEST(Order, IsRefusedWhereItCannotBeKept) {
  const TemporaryFolder folder;
  EncodeOptions options;
  options.keep_order = true;
  options.codec.hierarchy = Hierarchy::kLloyd;
  options.codec.offsets = Offsets::kCylindrical;
  EXPECT_FALSE(CheckOptions(options));
  WriteBytes(folder.File("scan.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\nf 1 2 3\n");
  try {
    Encode(folder.File("scan.obj"), folder.File("scan.folp"), ExactInOrder(100));
    FAIL() << "a face of two corners has no place";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.error().kind, ErrorKind::kInput);
    EXPECT_NE(failure.error().message.find("fewer than three corners"), std::string::npos);
  }
}

}  // namespace
}  // namespace folprom::support
