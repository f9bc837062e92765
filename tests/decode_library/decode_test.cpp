// The decoder library alone, from memory, layer by layer, on one thread.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <utility>

#include "folprom/decoder.h"
#include "tests/decode_library/program_files.h"

namespace folprom::decode_library {
namespace {

class DecodeLibrary : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { files_ = new ProgramFiles; }
  static void TearDownTestSuite() { delete std::exchange(files_, nullptr); }
  static ProgramFiles* files_;
};
ProgramFiles* DecodeLibrary::files_ = nullptr;

/// A mesh as it stands in a PLY file of floats.
void RoundToFloat(DecodedMesh* mesh) {
  for (auto& position : mesh->positions) {
    for (double& value : position) value = static_cast<double>(static_cast<float>(value));
  }
}

size_t ThreadsOfThisProcess() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("Threads:")) return std::stoul(line.substr(8));
  }
  return 0;
}

TEST_F(DecodeLibrary, GivesTheLodsOfTheProgramLayerByLayer) {
  const std::vector<uint8_t> file = files_->FolpBytes();
  auto decoder = MemoryDecoder::Open(file);
  ASSERT_TRUE(decoder.ok()) << decoder.error().message;
  EXPECT_GT(decoder->layer_count(), 5u);
  EXPECT_EQ(decoder->complete_layers(), decoder->layer_count());
  EXPECT_EQ(decoder->decoded_layers(), 0u);
  size_t vertices = 0;
  double bound = 1e300;
  while (decoder->decoded_layers() < decoder->layer_count()) {
    ASSERT_TRUE(decoder->DecodeNextLayer().ok());
    DecodedMesh mesh = decoder->Mesh();
    RoundToFloat(&mesh);
    const DecodedMesh expected = files_->DecodedByProgram(decoder->decoded_layers());
    ASSERT_EQ(mesh.positions, expected.positions) << decoder->decoded_layers();
    ASSERT_EQ(mesh.faces, expected.faces) << decoder->decoded_layers();
    EXPECT_GE(mesh.positions.size(), vertices);
    vertices = mesh.positions.size();
    bound = std::min(bound, decoder->error_bound());
  }
  EXPECT_EQ(bound, decoder->error_bound());
  EXPECT_EQ(vertices, files_->DecodedByProgram(decoder->layer_count()).positions.size());
  EXPECT_FALSE(decoder->DecodeNextLayer().ok());
}

TEST_F(DecodeLibrary, GoesOnWhereItStoodWhenMoved) {
  const std::vector<uint8_t> file = files_->FolpBytes();
  MemoryDecoder first = MemoryDecoder::Open(file).value();
  MemoryDecoder whole = MemoryDecoder::Open(file).value();
  for (int layer = 0; layer < 4; ++layer) ASSERT_TRUE(first.DecodeNextLayer().ok());
  MemoryDecoder second(std::move(first));
  EXPECT_EQ(second.decoded_layers(), 4u);
  while (second.decoded_layers() < second.layer_count()) ASSERT_TRUE(second.DecodeNextLayer().ok());
  while (whole.decoded_layers() < whole.layer_count()) ASSERT_TRUE(whole.DecodeNextLayer().ok());
  EXPECT_EQ(second.Mesh().positions, whole.Mesh().positions);
  EXPECT_EQ(second.Mesh().faces, whole.Mesh().faces);
}

TEST_F(DecodeLibrary, DecodesThePrefixThatHasArrived) {
  const std::vector<uint8_t> file = files_->FolpBytes();
  const std::span<const uint8_t> half = std::span(file).first(file.size() / 2);
  auto decoder = MemoryDecoder::Open(half);
  ASSERT_TRUE(decoder.ok()) << decoder.error().message;
  ASSERT_GT(decoder->complete_layers(), 0u);
  ASSERT_LT(decoder->complete_layers(), decoder->layer_count());
  while (decoder->decoded_layers() < decoder->complete_layers()) {
    ASSERT_TRUE(decoder->DecodeNextLayer().ok());
  }
  DecodedMesh mesh = decoder->Mesh();
  RoundToFloat(&mesh);
  EXPECT_EQ(mesh.positions, files_->DecodedByProgram(decoder->decoded_layers()).positions);
  const Result<void> more = decoder->DecodeNextLayer();
  ASSERT_FALSE(more.ok());
  EXPECT_EQ(more.error().kind, ErrorKind::kCorrupt);
}

TEST_F(DecodeLibrary, StartsNoThread) {
  const size_t before = ThreadsOfThisProcess();
  const std::vector<uint8_t> file = files_->FolpBytes();
  auto decoder = MemoryDecoder::Open(file);
  ASSERT_TRUE(decoder.ok());
  while (decoder->decoded_layers() < decoder->layer_count()) {
    ASSERT_TRUE(decoder->DecodeNextLayer().ok());
    EXPECT_EQ(ThreadsOfThisProcess(), before);
  }
}

TEST_F(DecodeLibrary, RefusesWhatIsNoFile) {
  for (const std::vector<uint8_t>& bytes : {std::vector<uint8_t>{}, std::vector<uint8_t>(100, 0xf7)}) {
    EXPECT_FALSE(MemoryDecoder::Open(bytes).ok());
  }
}

}  // namespace
}  // namespace folprom::decode_library
