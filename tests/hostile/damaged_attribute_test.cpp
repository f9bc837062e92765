// Attributes that no encoder writes, under checksums that fit.
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "parallel/progress.h"
#include "parallel/runner.h"
#include "tests/hostile/support.h"

namespace folprom::hostile {
namespace {

/// A sheet with a colour, a float, a double of noise and a constant per vertex, in several
/// subtrees.
Bytes FileWithAttributes() {
  const TestMesh sheet = WavySheet(14);
  std::string ply = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                    std::to_string(sheet.positions.size()) +
                    "\nproperty double x\nproperty double y\nproperty double z\n"
                    "property uchar red\nproperty float quality\nproperty double noise\n"
                    "property uchar alpha\n"
                    "element face " +
                    std::to_string(sheet.faces.size()) +
                    "\nproperty list uchar int vertex_indices\nend_header\n";
  const auto append = [&ply](const auto& value) {
    ply.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  std::mt19937_64 random(1);
  for (const auto& p : sheet.positions) {
    for (double value : p) append(value);
    append(static_cast<uint8_t>(random() % 50));
    append(static_cast<float>(p[0]));
    append(random());
    append(uint8_t{255});
  }
  for (const auto& f : sheet.faces) {
    append(uint8_t{3});
    append(f);
  }
  TemporaryFolder folder;
  WriteFile(folder.File("scan.ply"), ply);
  auto runner = parallel::MakeSerialRunner();
  parallel::Progress progress;
  EncodeFile(folder.File("scan.ply"), folder.File("scan.folp"), SmallOptions(), *runner, progress)
      .value();
  return FileContent(folder.File("scan.folp"));
}

/// Decodes all layers, or meets an error of the file's kind; as many values as vertices.
bool EndsWell(std::span<const uint8_t> file) {
  auto decoder = MemoryDecoder::Open(file);
  if (!decoder) {
    // Another magic or version is another kind of file.
    return decoder.error().kind == ErrorKind::kCorrupt || decoder.error().kind == ErrorKind::kInput;
  }
  while (decoder->decoded_layers() < decoder->layer_count()) {
    const Result<void> layer = decoder->DecodeNextLayer();
    if (!layer) return layer.error().kind == ErrorKind::kCorrupt;
    const DecodedMesh mesh = decoder->Mesh();
    const size_t vertices = mesh.positions.size();
    if (mesh.attributes.size() != 4 || mesh.attributes[0].values.size() != vertices ||
        mesh.attributes[1].values.size() != 4 * vertices ||
        mesh.attributes[2].values.size() != 8 * vertices) {
      return false;
    }
  }
  return true;
}

VerifyReport Verified(const Bytes& file) {
  TemporaryFolder folder;
  WriteFile(folder.File("forged.folp"), file);
  auto runner = parallel::MakeSerialRunner();
  parallel::Progress progress;
  DecodeOptions options;
  options.temporary_folder = folder.path();
  return VerifyFile(folder.File("forged.folp"), "", options, *runner, progress).value();
}

TEST(DamagedAttributeTest, EveryTruncationGivesTheLayersThatAreThere) {
  const Bytes file = FileWithAttributes();
  ASSERT_TRUE(EndsWell(file));
  for (size_t size = 0; size < file.size(); size += 3) {
    EXPECT_TRUE(EndsWell(std::span(file).first(size))) << size;
  }
}

TEST(DamagedAttributeTest, FlippedBitsAreSeen) {
  const Bytes file = FileWithAttributes();
  for (size_t bit = 0; bit < 8 * file.size(); bit += 41) {
    Bytes flipped = file;
    flipped[bit / 8] = static_cast<uint8_t>(flipped[bit / 8] ^ 1u << bit % 8);
    EXPECT_TRUE(EndsWell(flipped)) << bit;
    ErrorKind error;
    DecodeLods(flipped, &error);
    EXPECT_NE(error, ErrorKind::kUsage) << "bit " << bit << " is not seen";
  }
}

TEST(DamagedAttributeTest, SegmentsOfNoiseEndWell) {
  const Parts parts = TakeApart(FileWithAttributes());
  std::mt19937_64 random(2);
  for (int i = 0; i < 400; ++i) {
    Parts damaged = parts;
    Bytes& segment = damaged.segments[random() % damaged.segments.size()];
    if (segment.empty()) continue;
    for (size_t j = random() % segment.size(); j < segment.size(); ++j) {
      segment[j] = static_cast<uint8_t>(random());
    }
    EXPECT_TRUE(EndsWell(PutTogether(damaged))) << i;
  }
}

TEST(DamagedAttributeTest, OtherRangesAndTypesEndWellOrAreCorrupt) {
  const Parts parts = TakeApart(FileWithAttributes());
  for (size_t a = 0; a < 3; ++a) {
    for (uint64_t least : {uint64_t{0}, uint64_t{200}}) {
      Parts forged = parts;
      forged.table.attribute_ranges[a] = {least, 255};
      EXPECT_TRUE(EndsWell(PutTogether(forged))) << a;
    }
  }
  Parts forged = parts;
  std::swap(forged.table.schema.attributes[1].type, forged.table.schema.attributes[2].type);
  forged.table.attribute_ranges[1] = {0, ~uint64_t{0}};
  forged.table.attribute_ranges[2] = {0, 0xffffffff};
  ErrorKind error;
  DecodeLods(PutTogether(forged), &error);
  EXPECT_TRUE(error == ErrorKind::kCorrupt || error == ErrorKind::kUsage);
}

TEST(DamagedAttributeTest, AChangedValueIsNoticedByVerify) {
  Parts parts = TakeApart(FileWithAttributes());
  ASSERT_TRUE(Verified(PutTogether(parts)).lossless);
  // The values of a constant stand in the table alone.
  ASSERT_EQ(parts.table.attribute_ranges[3], (io::AttributeRange{255, 255}));
  parts.table.attribute_ranges[3] = {254, 254};
  const VerifyReport report = Verified(PutTogether(parts));
  EXPECT_FALSE(report.lossless);
  EXPECT_EQ(report.reason, "the decoded mesh differs from the digest in the file");
}

TEST(DamagedAttributeTest, AttributesOfTheCoderOfThePaperAreCorrupt) {
  Parts parts = TakeApart(SmallFile(Hierarchy::kLloyd));
  parts.table.schema.attributes = {{"red", ScalarType::kUint8}};
  parts.table.attribute_ranges = {{0, 255}};
  parts.table.attribute_bits = {0};
  ErrorKind error;
  DecodeLods(PutTogether(parts), &error);
  EXPECT_EQ(error, ErrorKind::kCorrupt);
}

}  // namespace
}  // namespace folprom::hostile
