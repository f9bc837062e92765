#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <string>
#include <tuple>

#include "tests/support/codec.h"
#include "tests/support/coders.h"
#include "tests/support/files.h"
#include "tests/support/ply.h"

namespace folprom::support {
namespace {

constexpr uint32_t kOneSubtree = 1 << 24;

/// file, bits, subtree_vertices, settings
using Param = std::tuple<std::string, uint32_t, uint32_t, CodecSettings>;

class SharedScanTest : public ::testing::TestWithParam<Param> {};

TEST_P(SharedScanTest, ComesBackWhole) {
  auto [name, bits, subtree_vertices, settings] = GetParam();
  if (name.empty()) GTEST_SKIP() << kNoSharedData;
  std::string scan = SharedFile(name);
  if (kSanitized && std::filesystem::file_size(scan) > 1000000) {
    GTEST_SKIP() << "too large for a build with sanitizers";
  }
  TemporaryFolder folder;
  std::string folp = folder.File("scan.folp"), out = folder.File("out.ply");
  auto runner = parallel::MakeTbbRunner(2);
  EncodeOptions options;
  options.codec = settings;
  options.bits = bits;
  options.codec.subtree_vertices = subtree_vertices;
  EncodeReport encoded = Encode(scan, folp, options, runner.get());
  DecodeReport decoded = Decode(folp, out, {}, runner.get());
  EXPECT_TRUE(decoded.complete);
  EXPECT_EQ(decoded.vertices, encoded.vertices);
  EXPECT_EQ(decoded.faces, encoded.faces);
  Mesh written = ReadPly(out).mesh;
  EXPECT_EQ(written.positions.size(), encoded.vertices);
  EXPECT_EQ(written.faces.size(), encoded.faces);

  VerifyReport by_digest = Verify(folp, "", runner.get());
  EXPECT_TRUE(by_digest.lossless) << by_digest.reason;
  VerifyReport by_scan = Verify(folp, scan, runner.get());
  EXPECT_TRUE(by_scan.lossless) << by_scan.reason;
  EXPECT_GT(by_scan.max_position_error, 0);
  EXPECT_LE(by_scan.max_position_error, by_scan.tolerance * (1 + 1e-9));
}

std::vector<std::string> ScansOrNone() {
  std::vector<std::string> names = SharedScans();
  if (names.empty()) names.push_back("");
  return names;
}

auto NameOfParam = [](const auto& given) {
  std::string file = std::get<0>(given.param);
  std::string name = file.empty() ? "NoData" : std::filesystem::path(file).stem().string();
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  uint32_t vertices = std::get<2>(given.param);
  return name + "_" + std::to_string(std::get<1>(given.param)) + "Bits_" +
         (vertices == kOneSubtree ? "OneSubtree" : "Subtrees");
};

INSTANTIATE_TEST_SUITE_P(All, SharedScanTest,
                         ::testing::Combine(::testing::ValuesIn(ScansOrNone()),
                                            ::testing::Values(12u, 16u),
                                            ::testing::Values(kOneSubtree, 20000u),
                                            ::testing::Values(CodecSettings())),
                         NameOfParam);
INSTANTIATE_TEST_SUITE_P(Lloyd, SharedScanTest,
                         ::testing::Combine(::testing::ValuesIn(ScansOrNone()),
                                            ::testing::Values(16u),
                                            ::testing::Values(kOneSubtree, 20000u),
                                            ::testing::Values(LloydSettings())),
                         NameOfParam);

}  // namespace
}  // namespace folprom::support
