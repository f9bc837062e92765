// Files cut anywhere and with any bit flipped: a fault that is named, or a mesh, never a crash.
#include <gtest/gtest.h>

#include "ply_builder.h"
#include "support.h"

namespace folprom::io {
namespace {

using testing::kAllFormats;
using testing::Mesh;
using testing::MixedFile;

std::string Triangles(PlyFormat format) {
  testing::PlyBuilder ply(format);
  ply.Header("element vertex 4").Header("property float x").Header("property float y");
  ply.Header("property float z").Header("element face 3");
  ply.Header("property list uchar int vertex_indices").Body();
  for (int v = 0; v < 4; ++v) {
    for (int axis = 0; axis < 3; ++axis) ply.Value(ScalarType::kFloat32, v * axis);
    ply.End();
  }
  for (int f = 0; f < 3; ++f) {
    ply.List(ScalarType::kUint8, ScalarType::kInt32, {double(f), double(f + 1), double(3 - f)})
        .End();
  }
  return ply.bytes();
}

std::string Strips(PlyFormat format) {
  testing::PlyBuilder ply(format);
  ply.Header("element tristrips 2").Header("property list int short vertex_indices");
  ply.Header("element vertex 5").Header("property char x").Header("property char y");
  ply.Header("property char z").Body();
  ply.List(ScalarType::kInt32, ScalarType::kInt16, {0, 1, 2, 3, -1, 2, 3, 4}).End();
  ply.List(ScalarType::kInt32, ScalarType::kInt16, {4, 0, 1}).End();
  for (int v = 0; v < 5; ++v) {
    for (int axis = 0; axis < 3; ++axis) ply.Value(ScalarType::kInt8, v - axis);
    ply.End();
  }
  return ply.bytes();
}

std::vector<std::string> SmallFiles() {
  std::vector<std::string> files;
  for (const PlyFormat format : kAllFormats) {
    files.push_back(MixedFile(format));
    files.push_back(Triangles(format));
    files.push_back(Strips(format));
  }
  return files;
}

TEST(PlyHostile, AFileCutAnywhereIsRefused) {
  for (const std::string& bytes : SmallFiles()) {
    const Mesh whole = testing::MeshOf(bytes).value();
    // Of a text file the last line end may be missing: all values are there.
    const bool text = bytes.find("ascii") != std::string::npos;
    for (size_t size = 0; size < bytes.size(); ++size) {
      const Result<Mesh> cut = testing::MeshOf(std::string_view(bytes).substr(0, size));
      if (text && size + 1 == bytes.size()) {
        ASSERT_TRUE(cut.ok());
        continue;
      }
      ASSERT_FALSE(cut.ok()) << "cut to " << size << " of " << bytes.size() << " bytes:\n" << bytes;
      ASSERT_EQ(cut.error().kind, ErrorKind::kInput);
    }
    EXPECT_EQ(testing::MeshOf(bytes + "trailing garbage").value().triangles, whole.triangles);
  }
}

TEST(PlyHostile, AnyBitMayBeFlipped) {
  for (const std::string& bytes : SmallFiles()) {
    const testing::TemporaryFolder folder;
    for (size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      std::string flipped = bytes;
      flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
      auto source = testing::OpenBytes(folder, flipped);
      const Result<Mesh> mesh = source ? testing::AllBlocks(**source) : source.error();
      if (!mesh.ok()) {
        ASSERT_EQ(mesh.error().kind, ErrorKind::kInput);
        ASSERT_FALSE(mesh.error().message.empty());
        continue;
      }
      Result<Mesh> again = testing::AllBlocks(**source);
      for (const Triangle& triangle : again->triangles) {
        for (const uint64_t index : triangle) ASSERT_LT(index, (*source)->vertex_count());
      }
    }
  }
}

TEST(PlyHostile, NumbersReplacedByHugeOnesAreRefused) {
  for (const std::string& bytes : SmallFiles()) {
    for (size_t i = 0; i < bytes.find("end_header"); ++i) {
      if (bytes[i] < '1' || bytes[i] > '9' || bytes[i - 1] != ' ') continue;
      for (const char* number : {"9223372036854775807", "18446744073709551615", "4294967296"}) {
        std::string changed = bytes;
        changed.replace(i, 1, number);
        const Result<Mesh> mesh = testing::MeshOf(changed);
        ASSERT_FALSE(mesh.ok()) << changed;
        ASSERT_EQ(mesh.error().kind, ErrorKind::kInput);
      }
    }
  }
}

}  // namespace
}  // namespace folprom::io
