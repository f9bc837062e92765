// The decoder library alone, from memory, layer by layer, on one thread.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

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

/// Positions as they stand in a PLY file of floats.
std::vector<std::array<float, 3>> AsFloats(const DecodedMesh& mesh) {
  std::vector<std::array<float, 3>> rounded;
  for (const auto& p : mesh.positions) {
    rounded.push_back(
        {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
  }
  return rounded;
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
    const DecodedMesh mesh = decoder->Mesh();
    const DecodedMesh expected = files_->DecodedByProgram(decoder->decoded_layers());
    ASSERT_EQ(AsFloats(mesh), AsFloats(expected)) << decoder->decoded_layers();
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
  EXPECT_EQ(AsFloats(decoder->Mesh()),
            AsFloats(files_->DecodedByProgram(decoder->decoded_layers())));
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
  for (const std::vector<uint8_t>& bytes :
       {std::vector<uint8_t>{}, std::vector<uint8_t>(100, 0xf7)}) {
    EXPECT_FALSE(MemoryDecoder::Open(bytes).ok());
  }
}

}  // namespace
}  // namespace folprom::decode_library
