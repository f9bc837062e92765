#include "tests/bench/peers/marked_file.h"

#include <gtest/gtest.h>

#include "folprom/result.h"
#include "tests/bench/peers/mesh_file.h"
#include "tests/support/files.h"

namespace folprom::peers {
namespace {

class MarkedFile : public ::testing::Test {
 protected:
  void Write(const std::string& text) { WriteBytes(path_, {text.begin(), text.end()}); }
  std::string Text() const {
    const auto bytes = ReadBytes(path_);
    return {bytes.begin(), bytes.end()};
  }
  const support::TemporaryFolder folder_;
  const std::string path_ = folder_.File("results.md");
};

TEST_F(MarkedFile, ReplacesOnlyWhatIsBetweenItsMarks) {
  Write("# A\n<!-- begin a b -->\nold\n<!-- end a b -->\n<!-- begin c -->\nc\n<!-- end c -->\nZ\n");
  ReplaceMarked(path_, "a b", "new\n");
  EXPECT_EQ(
      Text(),
      "# A\n<!-- begin a b -->\nnew\n<!-- end a b -->\n<!-- begin c -->\nc\n<!-- end c -->\nZ\n");
  ReplaceMarked(path_, "a b", "newer\n");
  EXPECT_NE(Text().find("-->\nnewer\n<!--"), std::string::npos);
}

TEST_F(MarkedFile, RefusesAFileWithoutTheMarks) {
  Write("<!-- end a -->\n<!-- begin a -->\n");
  EXPECT_THROW(CheckMarked(path_, "a"), Failure);
  EXPECT_THROW(ReplaceMarked(path_, "b", ""), Failure);
  EXPECT_THROW(CheckMarked(folder_.File("missing"), "a"), Failure);
}

}  // namespace
}  // namespace folprom::peers
