// More subtrees than a process may map files.
#include <gtest/gtest.h>

#include "tests/support/codec.h"
#include "tests/support/files.h"
#include "tests/support/ply.h"

namespace folprom::support {
namespace {

TEST(ManySubtrees, VerifyAgainstTheScan) {
  constexpr uint32_t kSubtrees = 33000;  // Linux maps 65,530 files, two a subtree would be more
  Mesh points;
  for (uint32_t i = 0; i < kSubtrees; ++i) {
    points.positions.push_back({static_cast<double>(i % 200), static_cast<double>(i / 200), 0});
  }
  TemporaryFolder folder;
  const std::string scan = folder.File("scan.ply"), folp = folder.File("scan.folp");
  WritePly(scan, points, CoordinateType::kFloat);
  EncodeOptions options;
  options.bits = 8;
  options.codec.subtree_vertices = 1;
  EXPECT_EQ(Encode(scan, folp, options).subtrees, kSubtrees);
  const VerifyReport report = Verify(folp, scan);
  EXPECT_TRUE(report.lossless) << report.reason;
}

}  // namespace
}  // namespace folprom::support
