// What an encoding takes, told before it begins, and a disk that has no room for it.
#include <sys/statvfs.h>
#include <unistd.h>

#include <cstdio>

#include "tests/cli/program.h"

namespace folprom::cli_test {
namespace {

namespace fs = std::filesystem;

class Estimate : public CliTest {
 protected:
  void SetUp() override {
    ASSERT_EQ(Run({"synth", "--vertices", "30k", "-o", Path("scan.ply"), "-q"}).exit_code, 0);
    fs::create_directory(Path("tmp"));
  }
};

TEST_F(Estimate, IsNearWhatTheEncodingTakes) {
  for (const std::string subtree : {"100k", "3k"}) {
    for (const char* kind : {"--bits=12", "--exact"}) {
      const std::vector<std::string> settings = {
          kind, "--subtree-vertices", subtree, "--tmp", Path("tmp"), "--json", "-T", "1"};
      std::vector<std::string> estimate = {"encode", Path("scan.ply"), "--estimate"};
      std::vector<std::string> encode = {"encode", Path("scan.ply"), "-o", Path("out.folp"), "-f"};
      estimate.insert(estimate.end(), settings.begin(), settings.end());
      encode.insert(encode.end(), settings.begin(), settings.end());
      const auto told = Run(estimate).json(), taken = Run(encode).json();
      EXPECT_EQ(told.at("vertices"), taken.at("vertices"));
      EXPECT_EQ(told.at("faces"), taken.at("faces"));
      const double spill = told.at("spill_bytes"), spilled = taken.at("spill_bytes");
      EXPECT_GT(spill, 0.9 * spilled) << kind << subtree;
      EXPECT_LT(spill, 1.4 * spilled) << kind << subtree;
      const double bytes = told.at("file_bytes"), written = taken.at("bytes");
      EXPECT_GT(bytes, written / 2) << kind << subtree;
      EXPECT_LT(bytes, written * 2) << kind << subtree;
      EXPECT_GT(told.at("memory_bytes"), uint64_t{20} << 20);
      EXPECT_GT(told.at("seconds"), 0.0);
    }
  }
}

TEST_F(Estimate, LeavesNothingAndNeedsNoOutput) {
  const Outcome outcome = Run({"encode", Path("scan.ply"), "--estimate", "--tmp", Path("tmp")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("30,000 vertices"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("temporary disk"), std::string::npos) << outcome.out;
  EXPECT_EQ(Files(), (std::vector<std::string>{"scan.ply", "tmp"}));
  EXPECT_TRUE(fs::is_empty(Path("tmp")));
}

TEST_F(Estimate, NamesAScanThatCannotBeRead) {
  ExpectError({"encode", Path("none.ply"), "--estimate"}, 3, "none.ply");
}

// A sparse file: all its vertices are at the origin, and no disk has room for their records.
TEST_F(Estimate, NoRoomOnTheDiskIsSaidBeforeAnyWork) {
  constexpr uint64_t kVertices = uint64_t{1} << 39;
  struct statvfs room {};
  ASSERT_EQ(statvfs(Path("tmp").c_str(), &room), 0);
  if (uint64_t{room.f_bavail} * room.f_frsize > 36 * kVertices) GTEST_SKIP() << "a disk of 20 TB";
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(kVertices) +
      "\nproperty float x\nproperty float y\nproperty float z\nelement face 0\n"
      "property list uchar int vertex_indices\nend_header\n";
  WriteText(Path("huge.ply"), header);
  if (truncate(Path("huge.ply").c_str(), static_cast<off_t>(header.size() + 12 * kVertices)) != 0) {
    GTEST_SKIP() << "the file system has no such large files";
  }
  const std::vector<std::string> before = Files();
  ExpectError({"encode", Path("huge.ply"), "-o", Path("huge.folp"), "--tmp", Path("tmp"), "-q",
               "--limit", "vertices=1000000000000"},
              5, "no room");
  EXPECT_EQ(Files(), before);
  EXPECT_TRUE(fs::is_empty(Path("tmp")));
}

}  // namespace
}  // namespace folprom::cli_test
