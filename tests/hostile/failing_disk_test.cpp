// Disks that are full, write short, or fail late: an output error, and the old output as it was.
#include "tests/hostile/failing_disk.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "parallel/progress.h"
#include "parallel/runner.h"
#include "tests/hostile/support.h"

namespace folprom::hostile {
namespace {

/// Encode, decode to each format, decode of a region; the outputs stand already.
class DiskFailure : public ::testing::Test {
 protected:
  struct Way {
    std::string output;
    std::function<Error(const std::string& output)> work;
  };

  DiskFailure() {
    WriteFile(folder_.File("scan.ply"), PlyBytes(WavySheet(12)));
    WriteFile(folder_.File("scan.folp"), Encoded(WavySheet(12), SmallOptions(60)));
    ways_.push_back({"out.folp", [this](const std::string& output) {
                       EncodeOptions options = SmallOptions(60);
                       options.temporary_folder = folder_.path();
                       options.overwrite = true;
                       return ErrorOf(EncodeFile(folder_.File("scan.ply"), output, options,
                                                 *runner_, progress_));
                     }});
    for (const std::string ending : {"ply", "obj", "stl", "off", "region.ply"}) {
      ways_.push_back({"out." + ending, [this, ending](const std::string& output) {
                         return Decode(output, ending == "region.ply");
                       }});
    }
    for (const Way& way : ways_) WriteFile(folder_.File(way.output), std::string_view("old"));
    before_ = folder_.Names();
  }

  template <class Report>
  static Error ErrorOf(const Result<Report>& report) {
    return report.ok() ? Error{ErrorKind::kUsage, ""} : report.error();
  }

  Error Decode(const std::string& output, bool region) {
    DecodeOptions options;
    options.temporary_folder = folder_.path();
    options.overwrite = true;
    options.use_region = region;
    for (double& hi : options.region_hi) hi = 1;
    return ErrorOf(DecodeFile(folder_.File("scan.folp"), output, options, *runner_, progress_));
  }

  void ExpectRefused(const Way& way, const Error& error, const std::string& reason,
                     const std::string& where) {
    EXPECT_EQ(error.kind, ErrorKind::kOutput) << where << ": " << error.message;
    EXPECT_NE(error.message.find(reason), std::string::npos) << where << ": " << error.message;
    EXPECT_TRUE(error.message.starts_with(folder_.path())) << where << ": " << error.message;
    const Bytes content = FileContent(folder_.File(way.output));
    EXPECT_EQ(std::string(content.begin(), content.end()), "old") << where;
    EXPECT_EQ(folder_.Names(), before_) << where;
  }

  TemporaryFolder folder_;
  std::unique_ptr<parallel::Runner> runner_ = parallel::MakeSerialRunner();
  parallel::Progress progress_;
  std::vector<Way> ways_;
  std::vector<std::string> before_;
};

TEST_F(DiskFailure, FullAfterAnyPartOfTheBytesIsToldAndKeepsTheOldOutput) {
  constexpr uint64_t kParts = 30;
  for (const Way& way : ways_) {
    uint64_t needed = 0;
    {
      const FailingDisk disk(DiskFault::kFull, uint64_t{1} << 40);
      ASSERT_EQ(way.work(folder_.File(way.output)).message, "");
      needed = disk.written();
    }
    ASSERT_GT(needed, kParts) << "nothing is written by what is made to fail";
    WriteFile(folder_.File(way.output), std::string_view("old"));
    for (uint64_t part = 0; part <= kParts; ++part) {
      // The last one lacks a single byte.
      const uint64_t room = part < kParts ? part * needed / kParts : needed - 1;
      Error error;
      {
        const FailingDisk disk(DiskFault::kFull, room);
        error = way.work(folder_.File(way.output));
        EXPECT_TRUE(disk.has_failed());
      }
      ExpectRefused(way, error, "No space left on device",
                    way.output + " with room for " + std::to_string(room));
    }
  }
}

TEST_F(DiskFailure, ShortWritesAreGoneOnWith) {
  for (const Way& way : ways_) {
    const std::string path = folder_.File(way.output);
    ASSERT_EQ(way.work(path).message, "");
    const Bytes whole = FileContent(path);
    {
      const FailingDisk disk(DiskFault::kShort, 7);
      EXPECT_EQ(way.work(path).message, "") << way.output;
      EXPECT_TRUE(disk.has_failed());
    }
    EXPECT_EQ(FileContent(path), whole) << way.output;
  }
}

TEST_F(DiskFailure, OfSyncOrRenameIsToldAndKeepsTheOldOutput) {
  for (const Way& way : ways_) {
    for (const auto& [fault, reason] : {std::pair{DiskFault::kSync, "cannot sync"},
                                        {DiskFault::kRename, "cannot rename into place"}}) {
      Error error;
      {
        const FailingDisk disk(fault, 0);
        error = way.work(folder_.File(way.output));
        EXPECT_TRUE(disk.has_failed()) << way.output;
      }
      ExpectRefused(way, error, reason, way.output);
    }
  }
}

TEST_F(DiskFailure, OfTheSyncOfTheFolderIsTold) {
  for (const Way& way : ways_) {
    Error error;
    {
      const FailingDisk disk(DiskFault::kSync, 1);
      error = way.work(folder_.File(way.output));
      EXPECT_TRUE(disk.has_failed()) << way.output;
    }
    EXPECT_EQ(error.kind, ErrorKind::kOutput) << way.output;
    EXPECT_NE(error.message.find("cannot sync the folder"), std::string::npos) << error.message;
    EXPECT_EQ(folder_.Names(), before_);
  }
}

}  // namespace
}  // namespace folprom::hostile
