// Pictures of a page: which are drawn, kept, and told of.
#include "apps/batch/page_pictures.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "apps/batch/batch_page.h"
#include "tests/support/codec.h"
#include "tests/support/files.h"
#include "tests/support/ply.h"
#include "tests/support/surfaces.h"
#include "tests/support/temporary_folder.h"

namespace folprom::batch {
namespace {

class PagePictures : public ::testing::Test {
 protected:
  void SetUp() override {
    support::WritePly(Path("a.ply"), support::BumpySphere(3000, false, 3),
                      support::CoordinateType::kFloat);
    support::Encode(Path("a.ply"), Path("a.folp"), {});
    result_.scan = "a.ply";
    result_.status = Status::kDone;
    result_.input = Path("a.ply");
    result_.folp = Path("a.folp");
  }
  std::string Path(const std::string& name) const { return folder_.File(name); }

  // Of the one scan.
  std::vector<PagePicture> Pictures(uint64_t memory_bytes = uint64_t{1} << 30) {
    const std::vector<ScanResults> scans = {{"", "a.ply", {&result_}}};
    const auto runner = parallel::MakeSerialRunner();
    const PictureSettings settings = {Path("pictures"), "", memory_bytes, 60, 48};
    return PicturesOf(scans, settings, &hashes_, *runner, progress_).at(0);
  }
  std::vector<std::string> Kept() const { return support::NamesIn(Path("pictures")); }

  support::TemporaryFolder folder_;
  OperationResult result_;
  HashCache hashes_;
  parallel::Progress progress_;
};

TEST_F(PagePictures, ShowThreeLevelsAndTheScan) {
  const auto pictures = Pictures();
  ASSERT_EQ(pictures.size(), 4u);
  for (const PagePicture& picture : pictures) {
    EXPECT_EQ(picture.problem, "");
    ASSERT_GT(picture.png.size(), 100u);
    EXPECT_EQ(picture.png[1], 'P');
    EXPECT_NE(picture.title.find(" vertices"), std::string::npos);
  }
  EXPECT_NE(pictures[0].caption.find("bits per vertex"), std::string::npos);
  EXPECT_EQ(pictures[3].caption, "the scan itself");
  for (size_t i = 1; i < 4; ++i) EXPECT_TRUE(pictures[i].png != pictures[i - 1].png);
}

TEST_F(PagePictures, ComeFromTheFolderTheSecondTime) {
  const auto first = Pictures();
  progress_.Cancel();
  const auto again = Pictures();
  ASSERT_EQ(again.size(), first.size());
  for (size_t i = 0; i < first.size(); ++i) EXPECT_TRUE(again[i].png == first[i].png) << i;
}

TEST_F(PagePictures, AreNotDrawnAfterACancellation) {
  progress_.Cancel();
  for (const PagePicture& picture : Pictures()) {
    EXPECT_TRUE(picture.png.empty());
    EXPECT_NE(picture.problem.find("interrupted"), std::string::npos);
  }
}

TEST_F(PagePictures, ReplaceThoseOfAnOlderFile) {
  Pictures();
  const auto before = Kept();
  EncodeOptions options;
  options.bits = 9;
  std::filesystem::remove(Path("a.folp"));
  support::Encode(Path("a.ply"), Path("a.folp"), options);
  Pictures();
  EXPECT_EQ(Kept().size(), 4u);
  EXPECT_NE(Kept(), before);
}

TEST_F(PagePictures, SayWhyTheyAreNotThere) {
  std::filesystem::remove(Path("a.ply"));
  auto pictures = Pictures();
  ASSERT_EQ(pictures.size(), 4u);
  EXPECT_TRUE(pictures[3].png.empty());
  EXPECT_NE(pictures[3].problem.find("a.ply"), std::string::npos);
  std::filesystem::remove(Path("a.folp"));
  pictures = Pictures();
  ASSERT_EQ(pictures.size(), 2u);
  EXPECT_NE(pictures[0].problem.find("a.folp"), std::string::npos);
}

TEST_F(PagePictures, KeepTheMemoryLimit) {
  const auto pictures = Pictures(10'000);
  for (const PagePicture& picture : pictures) {
    EXPECT_NE(picture.problem.find("memory limit"), std::string::npos) << picture.problem;
  }
}

TEST_F(PagePictures, AFailedScanHasItsOwnOnly) {
  result_.status = Status::kFailed;
  const auto pictures = Pictures();
  ASSERT_EQ(pictures.size(), 1u);
  EXPECT_FALSE(pictures[0].png.empty());
}

TEST_F(PagePictures, StandInThePageThatIsWritten) {
  BatchReport report;
  report.memory_bytes = uint64_t{1} << 30;
  report.results = {result_};
  const auto runner = parallel::MakeSerialRunner();
  WriteBatchPage(report, folder_.path(), "", true, &hashes_, *runner, progress_);
  const auto bytes = support::FileBytes(Path("report.html"));
  const std::string page(bytes.begin(), bytes.end());
  size_t pictures = 0;
  for (size_t at = page.find("<img "); at != std::string::npos; at = page.find("<img ", at + 1)) {
    ++pictures;
  }
  EXPECT_EQ(pictures, 4u);
}

}  // namespace
}  // namespace folprom::batch
