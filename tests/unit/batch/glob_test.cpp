// Which files a pattern names.
#include "apps/batch/glob.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace folprom::batch {
namespace {

namespace fs = std::filesystem;

class GlobFiles : public ::testing::Test {
 protected:
  GlobFiles() : root_(fs::canonical(folder_.path())) {
    for (const char* name : {"a.ply", "b.PLY", "c1.ply", "c2.ply", ".hidden.ply", "x/a.ply",
                             "x/y/a.ply", "x/y/b.stl", ".git/a.ply", "[odd].ply"}) {
      fs::create_directories((root_ / name).parent_path());
      std::ofstream(root_ / name) << "ply\n";
    }
    fs::create_directory(root_ / "folder.ply");
  }

  // Names below the root; what Files finds, Matches matches.
  std::vector<std::string> Names(const std::string& pattern) const {
    const Glob glob(root_ / pattern);
    std::vector<std::string> names;
    for (const std::string& file : glob.Files()) {
      EXPECT_TRUE(glob.Matches(file)) << file;
      names.push_back(fs::path(file).lexically_relative(root_).string());
    }
    return names;
  }

  support::TemporaryFolder folder_;
  const fs::path root_;
};

using Names_ = std::vector<std::string>;

TEST_F(GlobFiles, StarsStayInsideOneName) {
  EXPECT_EQ(Names("*.ply"), (Names_{"[odd].ply", "a.ply", "c1.ply", "c2.ply"}));
  EXPECT_EQ(Names("*/*.ply"), (Names_{"x/a.ply"}));
  EXPECT_EQ(Names("c?.ply"), (Names_{"c1.ply", "c2.ply"}));
  EXPECT_EQ(Names("c[2-9].ply"), (Names_{"c2.ply"}));
}

TEST_F(GlobFiles, TwoStarsAreAnyFoldersAndNone) {
  EXPECT_EQ(Names("**/a.ply"), (Names_{"a.ply", "x/a.ply", "x/y/a.ply"}));
  EXPECT_EQ(Names("x/**/*"), (Names_{"x/a.ply", "x/y/a.ply", "x/y/b.stl"}));
  EXPECT_EQ(Names("**/y/*.stl"), (Names_{"x/y/b.stl"}));
}

TEST_F(GlobFiles, HiddenNamesMustBeNamed) {
  EXPECT_EQ(Names(".*.ply"), (Names_{".hidden.ply"}));
  EXPECT_EQ(Names(".git/*"), (Names_{".git/a.ply"}));
  EXPECT_FALSE(Glob(root_ / "**/*.ply").Matches(root_ / ".git/a.ply"));
}

TEST_F(GlobFiles, PlainPathsAndWhatIsNotThere) {
  EXPECT_EQ(Names("x/../a.ply"), (Names_{"a.ply"}));
  EXPECT_EQ(Names("none.ply"), Names_{});
  EXPECT_EQ(Names("none/*.ply"), Names_{});
  EXPECT_EQ(Names("folder.ply"), Names_{});
}

TEST_F(GlobFiles, TellsOfFilesThatAreNotThereYet) {
  const Glob glob(root_ / "x/**/*.folp");
  EXPECT_TRUE(glob.Matches(root_ / "x/new.folp"));
  EXPECT_TRUE(glob.Matches(root_ / "x/p/q/new.folp"));
  EXPECT_FALSE(glob.Matches(root_ / "new.folp"));
  EXPECT_FALSE(glob.Matches(root_ / "xx/new.folp"));
  EXPECT_EQ(glob.root(), root_ / "x");
}

TEST_F(GlobFiles, FollowsLinksToFoldersWhereTheDepthIsBound) {
  fs::create_directory_symlink(root_ / "x", root_ / "link");
  fs::create_directory_symlink(root_, root_ / "x/circle");
  EXPECT_EQ(Names("*/a.ply"), (Names_{"link/a.ply", "x/a.ply"}));
  EXPECT_EQ(Names("**/a.ply"), (Names_{"a.ply", "x/a.ply", "x/y/a.ply"}));
}

}  // namespace
}  // namespace folprom::batch
