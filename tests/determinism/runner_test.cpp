#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "parallel/runner.h"
#include "tests/support/attribute_ply.h"
#include "tests/support/bit_mesh.h"
#include "tests/support/codec.h"
#include "tests/support/coders.h"
#include "tests/support/files.h"
#include "tests/support/ply.h"
#include "tests/support/surfaces.h"

namespace folprom::support {
namespace {

struct Way {
  std::string name;
  std::unique_ptr<parallel::Runner> runner;
  uint64_t memory_bytes;
};

/// Ways of running a job that must not show in its result.
std::vector<Way> Ways(size_t shuffles) {
  constexpr uint64_t kMiB = uint64_t{1} << 20;
  std::vector<Way> ways;
  for (int threads : {1, 2, 3, 8}) {
    ways.push_back(
        {std::to_string(threads) + " threads", parallel::MakeTbbRunner(threads), 2048 * kMiB});
  }
  for (uint64_t seed = 1; seed <= shuffles; ++seed) {
    ways.push_back({"shuffled with seed " + std::to_string(seed),
                    parallel::MakeShuffledRunner(seed), 2048 * kMiB});
  }
  for (uint64_t memory : {64 * kMiB, 512 * kMiB, 8192 * kMiB}) {
    ways.push_back({std::to_string(memory / kMiB) + " MiB", parallel::MakeTbbRunner(2), memory});
  }
  ways.push_back({"64 MiB, shuffled", parallel::MakeShuffledRunner(99), 64 * kMiB});
  return ways;
}

void ExpectEqualBytes(const std::vector<uint8_t>& expected, const std::vector<uint8_t>& actual) {
  ASSERT_EQ(expected.size(), actual.size());
  auto [at, other] = std::mismatch(expected.begin(), expected.end(), actual.begin());
  EXPECT_TRUE(at == expected.end()) << "first difference at byte " << at - expected.begin();
}

void ExpectSameBytes(const std::string& scan, EncodeOptions options, uint64_t least_subtrees,
                     size_t shuffles) {
  TemporaryFolder folder;
  std::string folp = folder.File("reference.folp"), ply = folder.File("reference.ply");
  EncodeReport report = Encode(scan, folp, options);
  EXPECT_GE(report.subtrees, least_subtrees);
  Decode(folp, ply);
  std::vector<uint8_t> encoded = FileBytes(folp), decoded = FileBytes(ply);
  for (const Way& way : Ways(shuffles)) {
    SCOPED_TRACE(way.name);
    options.limits.memory_bytes = way.memory_bytes;
    options.overwrite = true;
    Encode(scan, folder.File("again.folp"), options, way.runner.get());
    ExpectEqualBytes(encoded, FileBytes(folder.File("again.folp")));
    DecodeOptions decode;
    decode.limits.memory_bytes = way.memory_bytes;
    decode.overwrite = true;
    Decode(folp, folder.File("again.ply"), decode, way.runner.get());
    ExpectEqualBytes(decoded, FileBytes(folder.File("again.ply")));
  }
}

class RunnerTest : public ::testing::TestWithParam<Coder> {
 protected:
  static EncodeOptions Options(uint32_t subtree_vertices) {
    EncodeOptions options;
    options.codec = GetParam().settings;
    options.codec.subtree_vertices = subtree_vertices;
    return options;
  }
};
INSTANTIATE_TEST_SUITE_P(Coder, RunnerTest, EveryCoder(), NameOfCoder);

TEST_P(RunnerTest, NeverChangesTheBytesOfASurface) {
  TemporaryFolder folder;
  WritePly(folder.File("scan.ply"), BumpySphere(kSanitized ? 6000 : 20000, true, 1),
           CoordinateType::kFloat);
  ExpectSameBytes(folder.File("scan.ply"), Options(kSanitized ? 600 : 1500), 10, 5);
}

TEST_P(RunnerTest, NeverChangesTheBytesOfManySmallSubtrees) {
  TemporaryFolder folder;
  WritePly(folder.File("scan.ply"), BumpySphere(4000, true, 2), CoordinateType::kDouble);
  ExpectSameBytes(folder.File("scan.ply"), Options(50), 80, 5);
}

TEST(AttributeRunnerTest, NeverChangesTheBytesOfAttributes) {
  TemporaryFolder folder;
  AttributeMesh content{IntegerTerrain(70, 60, 3), 1, {"comment of the scanner"}};
  content.mesh.attributes = EveryType(content.mesh, 3);
  WriteAttributes(folder.File("scan.ply"), content);
  EncodeOptions options;
  options.codec.subtree_vertices = 400;
  ExpectSameBytes(folder.File("scan.ply"), options, 10, 3);
}

TEST(EffortRunnerTest, NeverChangesTheBytesAtLeastAndMostEffort) {
  TemporaryFolder folder;
  WritePly(folder.File("scan.ply"), BumpySphere(4000, true, 4), CoordinateType::kFloat);
  for (uint32_t effort : {1u, 9u}) {
    EncodeOptions options;
    options.codec = WithEffort(options.codec, effort);
    options.codec.subtree_vertices = 400;
    ExpectSameBytes(folder.File("scan.ply"), options, 8, 2);
  }
}

TEST(ExactRunnerTest, NeverChangesTheBytesOfAnExactFile) {
  for (CoordinateType type : {CoordinateType::kFloat, CoordinateType::kDouble}) {
    TemporaryFolder folder;
    WritePly(folder.File("scan.ply"), BumpySphere(kSanitized ? 3000 : 8000, true, 3), type);
    ExpectSameBytes(folder.File("scan.ply"), ExactOptions(500), 6, 3);
  }
}

TEST_P(RunnerTest, NeverChangesTheBytesOfDragon) {
  std::string scan = SharedFile("hard/dragon_vrip_res2.ply");
  if (scan.empty()) GTEST_SKIP() << kNoSharedData;
  if (kSanitized) GTEST_SKIP() << "too large for a build with sanitizers";
  ExpectSameBytes(scan, Options(15000), 6, 1);
}

}  // namespace
}  // namespace folprom::support
