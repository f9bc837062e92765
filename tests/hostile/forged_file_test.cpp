// Few bytes must not make much: what a file announces bounds what it may decode to.
#include "tests/hostile/forged_file.h"

#include <gtest/gtest.h>

#include "tests/hostile/guarded_child.h"

namespace folprom::hostile {
namespace {

constexpr uint64_t kAllowedBytes = uint64_t{64} << 20;

TEST(ForgedFile, OfHonestContentDecodes) {
  ErrorKind error;
  auto lods = DecodeLods(CopiedFacesFile(0), &error);
  ASSERT_EQ(lods.size(), 5u);
  EXPECT_EQ(lods.back().positions.size(), 100u);
  EXPECT_EQ(lods.back().faces.size(), 200u);
  lods = DecodeLods(CompleteGraphFile(100, 10000), &error);
  ASSERT_EQ(lods.size(), 5u);
  EXPECT_TRUE(lods.back().faces.empty());
}

TEST(ForgedFile, WithMoreFaceCopiesThanAnnouncedFacesIsCorrupt) {
  const Bytes file = CopiedFacesFile(100000);
  const std::string faults = RunGuarded(1, 20, kAllowedBytes + 64 * file.size(), [&](size_t) {
    ErrorKind error;
    DecodeLods(file, &error);
    return error == ErrorKind::kCorrupt;
  });
  EXPECT_EQ(faults, "") << file.size() << " bytes";
}

TEST(ForgedFile, WithMoreEdgesThanAnnouncedFacesHaveIsCorrupt) {
  const Bytes file = CompleteGraphFile(2500, 10);
  const std::string faults = RunGuarded(1, 20, kAllowedBytes + 64 * file.size(), [&](size_t) {
    ErrorKind error;
    DecodeLods(file, &error);
    return error == ErrorKind::kCorrupt;
  });
  EXPECT_EQ(faults, "") << file.size() << " bytes";
}

}  // namespace
}  // namespace folprom::hostile
