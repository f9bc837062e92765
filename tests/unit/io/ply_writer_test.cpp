#include "io/formats/mesh_writer.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <filesystem>

#include "support.h"

namespace folprom::io {
namespace {

using testing::AllBlocks;
using testing::FileContent;
using testing::TemporaryFolder;
using testing::WriteFile;

TEST(PlyWriter, WritesTheBytesThatReadersExpect) {
  const TemporaryFolder folder;
  auto writer =
      MeshWriter::Create(folder.File("out.ply"), {3, 1, ScalarType::kFloat32}, false).value();
  writer->AppendFaces(std::vector<Triangle>{{0, 1, 2}}).value();
  writer->AppendVertices(std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, -2}).value();
  writer->Commit().value();
  const std::string expected_header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  const std::string bytes = FileContent(folder.File("out.ply"));
  ASSERT_EQ(bytes.size(), expected_header.size() + 36 + 13);
  EXPECT_EQ(bytes.substr(0, expected_header.size()), expected_header);
  EXPECT_EQ(bytes.substr(bytes.size() - 13 - 4, 4), std::string("\0\0\0\xc0", 4));
  EXPECT_EQ(bytes.substr(bytes.size() - 13), std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13));
}

TEST(PlyWriter, KeepsTheBitsOfANan) {
  for (const ScalarType type : {ScalarType::kFloat32, ScalarType::kFloat64}) {
    const TemporaryFolder folder;
    std::vector<double> xyz;
    for (uint64_t bits : std::initializer_list<uint64_t>{0x7ff8000000000000, 0x7ff02468a0000000,
                                                         0xfff7ffffe0000000}) {
      xyz.push_back(std::bit_cast<double>(bits));
    }
    auto writer = MeshWriter::Create(folder.File("out.ply"), {1, 0, type}, false).value();
    writer->AppendVertices(xyz).value();
    writer->Commit().value();
    const auto source = MeshSource::Open(folder.File("out.ply")).value();
    const std::vector<double> read = AllBlocks(*source).value().xyz;
    ASSERT_EQ(read.size(), 3u);
    EXPECT_EQ(std::memcmp(read.data(), xyz.data(), 24), 0);
  }
}

TEST(PlyWriter, BringsBackLargeMeshesWrittenInAnyInterleaving) {
  const TemporaryFolder folder;
  constexpr uint64_t kCount = 150000;
  auto writer =
      MeshWriter::Create(folder.File("out.ply"), {kCount, kCount, ScalarType::kFloat64}, false)
          .value();
  std::vector<double> xyz;
  std::vector<Triangle> faces;
  for (uint64_t i = 0; i < kCount; ++i) {
    xyz.insert(xyz.end(), {0.1 * double(i), -double(i), 1e-300});
    faces.push_back({i, (i + 1) % kCount, kCount - 1 - i});
  }
  for (uint64_t begin = 0; begin < kCount; begin += 10000) {
    const std::span<const double> positions(xyz);
    writer->AppendVertices(positions.subspan(3 * begin, 30000)).value();
    writer->AppendFaces(std::span<const Triangle>(faces).subspan(begin, 10000)).value();
  }
  writer->Commit().value();
  const auto source = MeshSource::Open(folder.File("out.ply")).value();
  EXPECT_EQ(source->coordinate_type(), ScalarType::kFloat64);
  const testing::Mesh mesh = AllBlocks(*source).value();
  EXPECT_EQ(mesh.xyz, xyz);
  EXPECT_EQ(mesh.triangles, faces);
}

TEST(PlyWriter, WritesAnEmptyMesh) {
  const TemporaryFolder folder;
  MeshWriter::Create(folder.File("out.ply"), {0, 0, ScalarType::kFloat32}, false)
      .value()
      ->Commit()
      .value();
  const auto source = MeshSource::Open(folder.File("out.ply")).value();
  EXPECT_EQ(source->vertex_count(), 0u);
  EXPECT_EQ(AllBlocks(*source).value().triangles.size(), 0u);
}

TEST(PlyWriter, RefusesToCommitAnythingButWhatWasAnnounced) {
  const TemporaryFolder folder;
  WriteFile(folder.File("out.ply"), "old");
  const auto expect_internal = [](const Result<void>& result) {
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().kind, ErrorKind::kInternal);
  };
  {
    auto writer =
        MeshWriter::Create(folder.File("out.ply"), {2, 1, ScalarType::kFloat32}, true).value();
    expect_internal(writer->Commit());
    expect_internal(writer->AppendVertices(std::vector<double>(9, 0.0)));
    expect_internal(writer->AppendVertices(std::vector<double>(4, 0.0)));
    expect_internal(writer->AppendFaces(std::vector<Triangle>(2)));
    expect_internal(writer->AppendFaces(std::vector<Triangle>{{0, 1, 2}}));
  }
  EXPECT_EQ(FileContent(folder.File("out.ply")), "old");
}

TEST(PlyWriter, RefusesMoreVerticesThanIndicesCanName) {
  const TemporaryFolder folder;
  const auto too_many = MeshWriter::Create(folder.File("out.ply"),
                                           {uint64_t{1} << 32, 0, ScalarType::kFloat32}, false);
  ASSERT_FALSE(too_many.ok());
  EXPECT_EQ(too_many.error().kind, ErrorKind::kLimit);
  const auto too_large =
      MeshWriter::Create(folder.File("out.ply"), {3, UINT64_MAX, ScalarType::kFloat32}, false);
  EXPECT_EQ(too_large.error().kind, ErrorKind::kLimit);
  EXPECT_TRUE(folder.Names().empty());
}

TEST(PlyWriter, RefusesToOverwriteUnlessForced) {
  const TemporaryFolder folder;
  WriteFile(folder.File("out.ply"), "old");
  const auto writer =
      MeshWriter::Create(folder.File("out.ply"), {0, 0, ScalarType::kFloat32}, false);
  ASSERT_FALSE(writer.ok());
  EXPECT_EQ(writer.error().kind, ErrorKind::kOutput);
}

TEST(PlyWriter, ReportsAFullDisk) {
  const TemporaryFolder folder;
  {
    auto writer =
        MeshWriter::Create(folder.File("out.ply"), {1000, 0, ScalarType::kFloat64}, false).value();
    writer->AppendVertices(std::vector<double>(3000, 1.0)).value();
    const testing::FileSizeLimit limit(4096);
    const Result<void> result = writer->Commit();
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().kind, ErrorKind::kOutput);
  }
  EXPECT_TRUE(folder.Names().empty());
}

}  // namespace
}  // namespace folprom::io
