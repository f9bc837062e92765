// A job that is cancelled at any moment leaves nothing behind.
#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <functional>
#include <thread>

#include "parallel/progress.h"
#include "parallel/runner.h"
#include "tests/hostile/support.h"

namespace folprom::hostile {
namespace {

const TestMesh& Sheet() {
  static const TestMesh mesh = WavySheet(150);
  return mesh;
}

using Job = std::function<Result<void>(parallel::Runner&, parallel::Progress&)>;

/// Runs the job and cancels it from another thread as soon as `stage` has begun and at least `done`
/// units of it are finished. Returns the job's result.
Result<void> CancelledAt(const Job& job, const std::string& stage, uint64_t done, int threads) {
  auto runner = parallel::MakeTbbRunner(threads);
  parallel::Progress progress;
  std::atomic<bool> ended{false};
  std::thread canceller([&] {
    while (!ended && !(stage == progress.stage() && progress.done() >= done)) {
      std::this_thread::yield();
    }
    progress.Cancel();
  });
  Result<void> result = job(*runner, progress);
  ended = true;
  canceller.join();
  return result;
}

/// The stages that a job reports, in order.
std::vector<std::string> StagesOf(const Job& job) {
  auto runner = parallel::MakeSerialRunner();
  parallel::Progress progress;
  std::atomic<bool> ended{false};
  std::vector<std::string> stages;
  std::thread watcher([&] {
    while (!ended) {
      const char* stage = progress.stage();
      if (*stage != '\0' && (stages.empty() || stages.back() != stage)) stages.push_back(stage);
    }
  });
  EXPECT_TRUE(job(*runner, progress).ok());
  ended = true;
  watcher.join();
  return stages;
}

template <class Report>
Result<void> Outcome(Result<Report> report) {
  if (report.ok()) return {};
  return report.error();
}

class Interrupted : public ::testing::Test {
 protected:
  Interrupted() {
    WriteFile(folder_.File("scan.ply"), PlyBytes(Sheet()));
    auto runner = parallel::MakeSerialRunner();
    parallel::Progress progress;
    EncodeFile(folder_.File("scan.ply"), folder_.File("scan.folp"), SmallOptions(1000), *runner,
               progress)
        .value();
    before_ = folder_.Names();
  }
  Job Encode() {
    return [this](parallel::Runner& runner, parallel::Progress& progress) {
      EncodeOptions options = SmallOptions(1000);
      options.temporary_folder = folder_.path();
      return Outcome(
          EncodeFile(folder_.File("scan.ply"), folder_.File("out.ply"), options, runner, progress));
    };
  }
  Job Decode(bool region) {
    return [this, region](parallel::Runner& runner, parallel::Progress& progress) {
      DecodeOptions options;
      options.temporary_folder = folder_.path();
      options.use_region = region;
      for (size_t i = 0; i < 3; ++i) {
        options.region_lo[i] = -10;
        options.region_hi[i] = 0.7;
      }
      return Outcome(DecodeFile(folder_.File("scan.folp"), folder_.File("out.ply"), options, runner,
                                progress));
    };
  }
  Job Verify() {
    return [this](parallel::Runner& runner, parallel::Progress& progress) {
      DecodeOptions options;
      options.temporary_folder = folder_.path();
      return Outcome(VerifyFile(folder_.File("scan.folp"), folder_.File("scan.ply"), options,
                                runner, progress));
    };
  }
  /// Cancels at the beginning and in the middle of every stage. A stage may be over before the
  /// cancel arrives; the job then ends well or at the next stage.
  void ExpectNothingLeft(const Job& job, bool has_output) {
    const std::vector<std::string> stages = StagesOf(job);
    EXPECT_FALSE(stages.empty());
    std::remove(folder_.File("out.ply").c_str());
    int interrupted = 0;
    for (const std::string& stage : stages) {
      for (uint64_t done : {0, 1, 2000}) {
        const Result<void> result = CancelledAt(job, stage, done, 1 + static_cast<int>(done % 3));
        if (result.ok()) {
          std::vector<std::string> expected = before_;
          if (has_output) expected.insert(expected.begin(), "out.ply");
          EXPECT_EQ(folder_.Names(), expected) << stage << " " << done;
          std::remove(folder_.File("out.ply").c_str());
          continue;
        }
        ++interrupted;
        EXPECT_EQ(result.error().kind, ErrorKind::kInterrupted) << result.error().message;
        EXPECT_EQ(folder_.Names(), before_) << stage << " " << done;
      }
    }
    EXPECT_GT(interrupted, 0);
  }

  TemporaryFolder folder_;
  std::vector<std::string> before_;
};

TEST_F(Interrupted, EncodeLeavesNothing) { ExpectNothingLeft(Encode(), true); }
TEST_F(Interrupted, DecodeLeavesNothing) { ExpectNothingLeft(Decode(false), true); }
TEST_F(Interrupted, DecodeOfARegionLeavesNothing) { ExpectNothingLeft(Decode(true), true); }
TEST_F(Interrupted, VerifyLeavesNothing) { ExpectNothingLeft(Verify(), false); }

TEST_F(Interrupted, BeforeItBeginsDoesNothing) {
  for (const Job& job : {Encode(), Decode(false), Decode(true), Verify()}) {
    auto runner = parallel::MakeTbbRunner(2);
    parallel::Progress progress;
    progress.Cancel();
    const Result<void> result = job(*runner, progress);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().kind, ErrorKind::kInterrupted);
    EXPECT_EQ(folder_.Names(), before_);
  }
}

TEST_F(Interrupted, KeepsTheOutputOfBefore) {
  WriteFile(folder_.File("out.ply"), std::string_view("old"));
  before_ = folder_.Names();
  auto runner = parallel::MakeTbbRunner(2);
  parallel::Progress progress;
  std::atomic<bool> ended{false};
  std::thread canceller([&] {
    while (!ended && std::strcmp(progress.stage(), "encode") != 0) std::this_thread::yield();
    progress.Cancel();
  });
  EncodeOptions options = SmallOptions(1000);
  options.temporary_folder = folder_.path();
  options.overwrite = true;
  auto report =
      EncodeFile(folder_.File("scan.ply"), folder_.File("out.ply"), options, *runner, progress);
  ended = true;
  canceller.join();
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().kind, ErrorKind::kInterrupted);
  EXPECT_EQ(folder_.Names(), before_);
  EXPECT_EQ(FileContent(folder_.File("out.ply")), (Bytes{'o', 'l', 'd'}));
}

}  // namespace
}  // namespace folprom::hostile
