// Sections that are cut, damaged or forged: an error with the place, or triangles with a warning.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "folprom/decoder.h"
#include "io/container/block_code.h"
#include "io/container/reader.h"
#include "tests/support/codec.h"
#include "tests/support/files.h"
#include "tests/support/meshes.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace folprom::support {
namespace {

using Bytes = std::vector<uint8_t>;

/// A file with all sections, or without the order.
Bytes SmallFile(bool keep_order) {
  const TemporaryFolder folder;
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 100\nproperty float x\nproperty float y\n"
      "property float z\nelement face 81\nproperty uchar red\n"
      "property list uchar int vertex_indices\nproperty list uchar float texcoord\nend_header\n";
  for (int i = 0; i < 100; ++i) {
    text += std::to_string(i % 10) + " " + std::to_string(i / 10) + " " +
            std::to_string(i * i % 5) + "\n";
  }
  for (int i = 0; i < 81; ++i) {
    const int a = i / 9 * 10 + i % 9;
    for (const int value : {i / 20, 4, a, a + 1, a + 11, a + 10, 8}) {
      text += std::to_string(value);
      text += ' ';
    }
    for (int corner = 0; corner < 8; ++corner) {
      text += std::to_string((a + corner) % 40);
      text += corner < 7 ? ' ' : '\n';
    }
  }
  WriteBytes(folder.File("scan.ply"), text);
  EncodeOptions options;
  options.keep_order = keep_order;
  options.codec.subtree_vertices = 40;
  Encode(folder.File("scan.ply"), folder.File("scan.folp"), options);
  return FileBytes(folder.File("scan.folp"));
}

io::ContainerReader Open(const Bytes& file) {
  return io::ContainerReader::Open(file, "scan.folp").value();
}

/// Decodes everything; the error, if there is one.
std::string ErrorOf(const Bytes& file, ErrorKind* kind = nullptr) {
  auto decoder = MemoryDecoder::Open(file);
  if (!decoder) return decoder.error().message;
  while (decoder.value().decoded_layers() < decoder.value().complete_layers()) {
    const Result<void> decoded = decoder.value().DecodeNextLayer();
    if (decoded) continue;
    if (kind != nullptr) *kind = decoded.error().kind;
    return decoded.error().message;
  }
  const DecodedMesh mesh = decoder.value().Mesh();
  for (const auto& face : mesh.faces) {
    for (const uint64_t corner : face) {
      if (corner >= mesh.positions.size()) return "a corner that is no vertex";
    }
  }
  return "";
}

TEST(DamagedSection, CutAnywhereTheFileIsTriangles) {
  for (const bool keep_order : {true, false}) {
    const Bytes file = SmallFile(keep_order);
    const io::ContainerReader container = Open(file);
    const auto first = keep_order ? io::SectionKind::kOrder : io::SectionKind::kPolygons;
    const auto begin = static_cast<size_t>(container.Section(first).data() - file.data());
    const TemporaryFolder folder;
    for (size_t size = begin; size < file.size(); ++size) {
      const Bytes cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size));
      ASSERT_EQ(ErrorOf(cut), "");
      auto decoder = MemoryDecoder::Open(cut);
      while (decoder.value().DecodeNextLayer()) {
      }
      EXPECT_FALSE(decoder.value().Mesh().has_scan_order);
      EXPECT_EQ(decoder.value().Mesh().faces.size(), 162u);
    }
    WriteBytes(folder.File("cut.folp"), {reinterpret_cast<const char*>(file.data()), begin + 3});
    const DecodeReport report = Decode(folder.File("cut.folp"), folder.File("back.ply"));
    ASSERT_EQ(report.warnings.size(), 1u);
    EXPECT_NE(report.warnings[0].find("the file is cut"), std::string::npos);
    EXPECT_FALSE(Verify(folder.File("cut.folp"), "").lossless);
  }
}

TEST(DamagedSection, EveryFlippedBitIsFound) {
  for (const bool keep_order : {true, false}) {
    const Bytes file = SmallFile(keep_order);
    const io::ContainerReader container = Open(file);
    const auto first = keep_order ? io::SectionKind::kOrder : io::SectionKind::kPolygons;
    const auto begin = static_cast<size_t>(container.Section(first).data() - file.data());
    for (size_t bit = 8 * begin; bit < 8 * file.size(); ++bit) {
      Bytes damaged = file;
      damaged[bit / 8] = static_cast<uint8_t>(damaged[bit / 8] ^ 1u << bit % 8);
      ErrorKind kind = ErrorKind::kInternal;
      ASSERT_NE(ErrorOf(damaged, &kind), "") << "bit " << bit;
      EXPECT_EQ(kind, ErrorKind::kCorrupt);
    }
  }
}

/// The whole mesh of a file that has no fault.
DecodedMesh MeshOf(const Bytes& file) {
  auto decoder = MemoryDecoder::Open(file);
  while (decoder.value().decoded_layers() < decoder.value().complete_layers()) {
    decoder.value().DecodeNextLayer().value();
  }
  return decoder.value().Mesh();
}

/// With the bytes of a section changed, and checksums that agree with them.
TEST(DamagedSection, ForgedBitsAreAnErrorOrTheSameMesh) {
  Random random(11);
  for (const bool keep_order : {true, false}) {
    const Bytes file = SmallFile(keep_order);
    const io::ContainerReader container = Open(file);
    const DecodedMesh honest = MeshOf(file);
    for (const auto kind :
         {io::SectionKind::kOrder, io::SectionKind::kPolygons, io::SectionKind::kFaceValues}) {
      if (!container.table().Section(kind)) continue;
      const auto section = container.Section(kind);
      const auto begin = static_cast<size_t>(section.data() - file.data());
      for (int i = 0; i < 300; ++i) {
        Bytes forged = file;
        size_t at = begin;
        // Any block of the section.
        io::BlockReader blocks(section, "");
        std::vector<std::pair<size_t, size_t>> places;
        while (!blocks.AtEnd()) {
          const size_t size = blocks.Next().size();
          places.emplace_back(at, size);
          at += size + 8;
        }
        const auto [block, size] = places[random.Below(places.size())];
        for (uint64_t changes = 1 + random.Below(4); size > 0 && changes > 0; --changes) {
          forged[block + 4 + random.Below(size)] = static_cast<uint8_t>(random.Below(256));
        }
        const Bytes bits(forged.begin() + static_cast<std::ptrdiff_t>(block + 4),
                         forged.begin() + static_cast<std::ptrdiff_t>(block + 4 + size));
        const Bytes framed = io::FramedBlock(bits);
        std::ranges::copy(framed, forged.begin() + static_cast<std::ptrdiff_t>(block));
        if (forged == file) continue;
        const std::string error = ErrorOf(forged);
        if (error.empty()) {
          // Other bits of the same decisions; of any others the digest tells.
          const DecodedMesh mesh = MeshOf(forged);
          EXPECT_TRUE(mesh.positions == honest.positions && mesh.faces == honest.faces &&
                      mesh.polygon_begin == honest.polygon_begin);
          for (size_t a = 0; a < 2; ++a) {
            EXPECT_EQ(mesh.face_attributes[a].values, honest.face_attributes[a].values);
          }
        } else {
          EXPECT_NE(error.find("memory: "), std::string::npos) << error;
        }
      }
    }
  }
}

}  // namespace
}  // namespace folprom::support
