#include "parallel/progress.h"

#include <gtest/gtest.h>

#include <atomic>

#include "tests/unit/parallel/runners.h"

namespace folprom::parallel {
namespace {

TEST(ProgressTest, AddsUpWhatTasksReport) {
  Progress progress;
  progress.StartStage("split", 1000);
  MakeTbbRunner(4)->ForEach(100, [&](size_t) { progress.Advance(10); });
  EXPECT_STREQ(progress.stage(), "split");
  EXPECT_EQ(progress.total(), 1000u);
  EXPECT_EQ(progress.done(), 1000u);
}

TEST(ProgressTest, StartsEachStageAtZero) {
  Progress progress;
  progress.StartStage("first", 5);
  progress.Advance(5);
  progress.StartStage("second", 7);
  EXPECT_STREQ(progress.stage(), "second");
  EXPECT_EQ(progress.done(), 0u);
  EXPECT_EQ(progress.total(), 7u);
}

TEST(ProgressTest, StaysCancelledAcrossStages) {
  Progress progress;
  progress.ThrowIfCancelled();
  progress.Cancel();
  progress.StartStage("next", 1);
  EXPECT_THROW(progress.ThrowIfCancelled(), Cancelled);
  EXPECT_THROW(progress.Advance(1), Cancelled);
}

using CancelTest = EachRunner;
INSTANTIATE_TEST_SUITE_P(Runners, CancelTest, testing::ValuesIn(AllRunners()), RunnerName);

TEST_P(CancelTest, EndsForEach) {
  constexpr size_t kTasks = 1000000;
  Progress progress;
  std::atomic<size_t> started{0};
  const auto task = [&](size_t) {
    if (++started == 100) progress.Cancel();
    progress.Advance(1);
  };
  EXPECT_THROW(runner_->ForEach(kTasks, task), Cancelled);
  EXPECT_LT(started, kTasks);
}

TEST_P(CancelTest, EndsOrdered) {
  constexpr size_t kTasks = 1000000;
  Progress progress;
  size_t consumed = 0;
  const auto consume = [&](size_t) {
    if (++consumed == 100) progress.Cancel();
  };
  EXPECT_THROW(runner_->Ordered(
                   kTasks, 8, [&](size_t) { progress.Advance(1); }, consume),
               Cancelled);
  EXPECT_LT(consumed, 200u);
}

}  // namespace
}  // namespace folprom::parallel
