// What each format is written as, and that its reader gives the same mesh back.
#include "io/formats/mesh_writer.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <limits>

#include "folprom/float_bits.h"
#include "support.h"
#include "tests/support/random.h"

namespace folprom::io {
namespace {

using testing::AllBlocks;
using testing::FileContent;
using testing::Mesh;
using testing::TemporaryFolder;

constexpr const char* kNames[] = {"a.ply", "a.obj", "a.off", "a.stl"};

/// The bits, so that -0.0 is not 0.0 and a NaN is itself.
std::vector<uint64_t> Bits(const std::vector<double>& values) {
  std::vector<uint64_t> bits;
  for (double value : values) bits.push_back(std::bit_cast<uint64_t>(value));
  return bits;
}

/// Appends pieces of vertices and faces in turn, faces first.
std::vector<std::string> Write(const std::string& path, const Mesh& mesh, ScalarType type) {
  const MeshShape shape{mesh.xyz.size() / 3, mesh.triangles.size(), type};
  auto writer = MeshWriter::Create(path, shape, true).value();
  constexpr size_t kPiece = 10000;
  for (size_t i = 0; i < std::max(mesh.xyz.size() / 3, mesh.triangles.size()); i += kPiece) {
    const std::span<const Triangle> faces(mesh.triangles);
    const std::span<const double> xyz(mesh.xyz);
    if (i < faces.size()) {
      writer->AppendFaces(faces.subspan(i, std::min(kPiece, faces.size() - i))).value();
    }
    if (3 * i < xyz.size()) {
      writer->AppendVertices(xyz.subspan(3 * i, std::min(3 * kPiece, xyz.size() - 3 * i))).value();
    }
  }
  writer->Commit().value();
  return writer->Warnings();
}

Mesh RandomMesh(uint64_t vertices, uint64_t faces, ScalarType type) {
  support::Random random(vertices);
  Mesh mesh;
  for (uint64_t i = 0; i < 3 * vertices; ++i) {
    const double value = random.Between(-100, 100);
    mesh.xyz.push_back(type == ScalarType::kFloat32 ? static_cast<float>(value) : value);
  }
  for (uint64_t f = 0; f < faces; ++f) {
    mesh.triangles.push_back(
        {random.Below(vertices), random.Below(vertices), random.Below(vertices)});
  }
  return mesh;
}

/// The facets of a mesh, with no vertex shared.
Mesh SoupOf(const Mesh& mesh) {
  Mesh soup;
  for (uint64_t f = 0; f < mesh.triangles.size(); ++f) {
    for (const uint64_t vertex : mesh.triangles[f]) {
      soup.xyz.insert(soup.xyz.end(), &mesh.xyz[3 * vertex], &mesh.xyz[3 * vertex] + 3);
    }
    soup.triangles.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  }
  return soup;
}

TEST(MeshWriter, GivesEveryMeshBackInItsOrder) {
  const TemporaryFolder folder;
  for (const std::string name : kNames) {
    for (const ScalarType type : {ScalarType::kFloat32, ScalarType::kFloat64}) {
      if (name == "a.stl" && type == ScalarType::kFloat64) continue;
      for (const auto& [vertices, faces] : {std::pair{3, 1}, {70000, 150000}, {100000, 0}}) {
        const Mesh mesh = RandomMesh(vertices, faces, type);
        const Mesh expected = name == "a.stl" ? SoupOf(mesh) : mesh;
        Write(folder.File(name), mesh, type);
        const auto source = MeshSource::Open(folder.File(name)).value();
        if (!expected.xyz.empty()) {
          EXPECT_EQ(source->coordinate_type(), type) << name;
        }
        const Mesh read = AllBlocks(*source).value();
        EXPECT_TRUE(Bits(read.xyz) == Bits(expected.xyz)) << name;
        EXPECT_TRUE(read.triangles == expected.triangles) << name;
        EXPECT_EQ(folder.Names(), std::vector<std::string>{name});
        std::remove(folder.File(name).c_str());
      }
    }
  }
}

TEST(MeshWriter, GivesAnEmptyMeshBack) {
  const TemporaryFolder folder;
  for (const char* name : kNames) {
    Write(folder.File(name), {}, ScalarType::kFloat64);
    const Mesh read = AllBlocks(*MeshSource::Open(folder.File(name)).value()).value();
    EXPECT_TRUE(read.xyz.empty() && read.triangles.empty()) << name;
  }
}

TEST(MeshWriter, WritesTheTextThatReadersExpect) {
  const TemporaryFolder folder;
  Mesh mesh;
  mesh.xyz = {0.1f, -0.0, 1e20f, 1.5, 16777216, -3, 0, 1e-7f, 100000};
  mesh.triangles = {{0, 1, 2}, {2, 1, 1}};
  EXPECT_TRUE(Write(folder.File("a.obj"), mesh, ScalarType::kFloat32).empty());
  EXPECT_EQ(FileContent(folder.File("a.obj")),
            "# 3 vertices, 2 faces\nv 0.1 -0 1e+20\nv 1.5 16777216 -3\nv 0 1e-07 1e+05\n"
            "f 1 2 3\nf 3 2 2\n");
  EXPECT_TRUE(Write(folder.File("a.off"), mesh, ScalarType::kFloat32).empty());
  EXPECT_EQ(FileContent(folder.File("a.off")),
            "OFF\n3 2 0\n0.1 -0 1e+20\n1.5 16777216 -3\n0 1e-07 1e+05\n3 0 1 2\n3 2 1 1\n");
}

TEST(MeshWriter, KeepsEveryFloatAndDoubleInText) {
  const TemporaryFolder folder;
  const double infinity = std::numeric_limits<double>::infinity();
  support::Random random(9);
  std::vector<double> floats = {0.0, -0.0, infinity, -infinity, 1e-45f, 3.4028235e38f};
  std::vector<double> doubles = {0.0, -0.0, infinity, -infinity, 5e-324, 1.7976931348623157e308};
  while (floats.size() < 3000) {
    const float value = std::bit_cast<float>(static_cast<uint32_t>(random.Next()));
    if (value == value) floats.push_back(value);
    const double wide = std::bit_cast<double>(random.Next());
    if (wide == wide) doubles.push_back(wide);
  }
  floats.resize(3000);
  doubles.resize(2700);
  // One coordinate that no float is tells the type of all, be its decimal ever so short.
  const std::vector<double> short_decimal = {0.5, 0.1, 0.25, 0.1, 0.2, 1e10};
  for (const std::string name : {"a.obj", "a.off"}) {
    for (const auto& [values, type] : {std::pair{floats, ScalarType::kFloat32},
                                       {doubles, ScalarType::kFloat64},
                                       {short_decimal, ScalarType::kFloat64}}) {
      EXPECT_TRUE(Write(folder.File(name), {values, {}}, type).empty());
      const auto source = MeshSource::Open(folder.File(name)).value();
      EXPECT_EQ(source->coordinate_type(), type);
      EXPECT_TRUE(Bits(AllBlocks(*source).value().xyz) == Bits(values)) << name;
    }
  }
}

TEST(MeshWriter, NamesWhatTheFormatDoesNotHold) {
  const TemporaryFolder folder;
  const Mesh shared = RandomMesh(5, 4, ScalarType::kFloat32);
  const Mesh soup = SoupOf(shared);
  EXPECT_TRUE(Write(folder.File("a.stl"), soup, ScalarType::kFloat32).empty());
  ASSERT_EQ(Write(folder.File("a.stl"), shared, ScalarType::kFloat32).size(), 1u);
  EXPECT_NE(Write(folder.File("a.stl"), shared, ScalarType::kFloat32)[0].find("share a vertex"),
            std::string::npos);
  Mesh wide = soup;
  wide.xyz[7] = 0.1;
  wide.xyz[8] = 1e300;
  EXPECT_EQ(Write(folder.File("a.stl"), wide, ScalarType::kFloat64),
            std::vector<std::string>{"STL holds float32: 2 coordinates are rounded"});

  Mesh nans = soup;
  nans.xyz[0] = std::numeric_limits<double>::quiet_NaN();
  nans.xyz[1] = -nans.xyz[0];
  EXPECT_TRUE(Write(folder.File("a.obj"), nans, ScalarType::kFloat32).empty());
  EXPECT_TRUE(Bits(AllBlocks(*MeshSource::Open(folder.File("a.obj")).value()).value().xyz) ==
              Bits(nans.xyz));
  nans.xyz[2] = WidenFloat(std::bit_cast<float>(0x7f812345));
  EXPECT_EQ(Write(folder.File("a.obj"), nans, ScalarType::kFloat32),
            std::vector<std::string>{"OBJ holds text: 1 NaN lose their payload"});
  EXPECT_TRUE(Write(folder.File("a.stl"), nans, ScalarType::kFloat32).empty());
}

TEST(MeshWriter, WritesStlThatNoReaderTakesForTextWithNormals) {
  const TemporaryFolder folder;
  Mesh mesh;
  mesh.xyz = {0, 0, 0, 2, 0, 0, 0, 2, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {2, 1, 0}};
  Write(folder.File("a.stl"), mesh, ScalarType::kFloat32);
  const std::string bytes = FileContent(folder.File("a.stl"));
  ASSERT_EQ(bytes.size(), 84u + 3 * 50);
  EXPECT_FALSE(bytes.starts_with("solid"));
  const float expected[] = {1, 0, -1};
  for (size_t f = 0; f < 3; ++f) {
    float normal[3];
    std::memcpy(normal, bytes.data() + 84 + 50 * f, sizeof normal);
    EXPECT_EQ(normal[0], 0);
    EXPECT_EQ(normal[1], 0);
    EXPECT_EQ(normal[2], expected[f]);
  }
}

TEST(MeshWriter, RefusesOtherEndingsAndTakesLargeLetters) {
  const TemporaryFolder folder;
  for (const char* name : {"a", "a.", "a.ply2", ".off", "a.stl.gz"}) {
    const auto writer = MeshWriter::Create(folder.File(name), {}, false);
    ASSERT_FALSE(writer.ok());
    EXPECT_EQ(writer.error().kind, ErrorKind::kUsage);
  }
  EXPECT_TRUE(folder.Names().empty());
  EXPECT_TRUE(MeshWriter::Create(folder.File("a.OBJ"), {}, false).ok());
}

TEST(MeshWriter, RefusesWhatAnStlCannotCount) {
  const TemporaryFolder folder;
  for (const MeshShape& shape : {MeshShape{uint64_t{1} << 32, 0}, {3, uint64_t{1} << 32}}) {
    const auto writer = MeshWriter::Create(folder.File("a.stl"), shape, false);
    ASSERT_FALSE(writer.ok());
    EXPECT_EQ(writer.error().kind, ErrorKind::kLimit);
  }
}

TEST(MeshWriter, ReportsAFullDiskAndLeavesNothing) {
  const TemporaryFolder folder;
  const Mesh mesh = RandomMesh(1000, 2000, ScalarType::kFloat64);
  for (const char* name : kNames) {
    const testing::FileSizeLimit limit(9000);
    EXPECT_THROW(Write(folder.File(name), mesh, ScalarType::kFloat64), Failure) << name;
    EXPECT_TRUE(folder.Names().empty()) << name;
  }
}

TEST(MeshWriter, AbandonedLeavesTheOldFile) {
  const TemporaryFolder folder;
  for (const char* name : kNames) {
    testing::WriteFile(folder.File(name), "old");
    {
      const auto writer = MeshWriter::Create(folder.File(name), {3, 1}, true).value();
      writer->AppendFaces(std::vector<Triangle>{{0, 1, 2}}).value();
      EXPECT_FALSE(writer->AppendFaces(std::vector<Triangle>{{0, 1, 2}}).ok());
      EXPECT_FALSE(writer->Commit().ok());
    }
    EXPECT_EQ(FileContent(folder.File(name)), "old");
  }
  EXPECT_EQ(folder.Names().size(), 4u);
}

}  // namespace
}  // namespace folprom::io
