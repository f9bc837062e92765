#include <atomic>
#include <chrono>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "tests/unit/parallel/runners.h"

namespace folprom::parallel {
namespace {

using ForEachTest = EachRunner;
INSTANTIATE_TEST_SUITE_P(Runners, ForEachTest, testing::ValuesIn(AllRunners()), RunnerName);

TEST_P(ForEachTest, CallsEachIndexOnce) {
  std::vector<std::atomic<int>> calls(10000);
  runner_->ForEach(calls.size(), [&](size_t i) { ++calls[i]; });
  for (const auto& count : calls) EXPECT_EQ(count, 1);
}

TEST_P(ForEachTest, CallsNothingForZeroTasks) {
  runner_->ForEach(0, [](size_t) { FAIL(); });
}

TEST_P(ForEachTest, ShowsTheCallerWhatTasksWrote) {
  std::vector<uint64_t> squares(5000);
  std::vector<uint64_t> numbers(5000);
  for (size_t i = 0; i < numbers.size(); ++i) numbers[i] = i;
  runner_->ForEach(squares.size(), [&](size_t i) { squares[i] = numbers[i] * numbers[i]; });
  for (size_t i = 0; i < squares.size(); ++i) ASSERT_EQ(squares[i], i * i);
}

TEST_P(ForEachTest, KeepsToItsNumberOfThreads) {
  ASSERT_GE(runner_->threads(), 1);
  std::atomic<int> running{0};
  std::atomic<int> most{0};
  runner_->ForEach(200, [&](size_t) {
    const int now = ++running;
    int seen = most;
    while (seen < now && !most.compare_exchange_weak(seen, now)) {
    }
    std::this_thread::yield();
    --running;
  });
  EXPECT_LE(most, runner_->threads());
}

TEST_P(ForEachTest, RethrowsWhatATaskThrew) {
  try {
    runner_->ForEach(100, [](size_t i) {
      if (i == 40) throw std::runtime_error("task 40");
    });
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "task 40");
  }
}

TEST_P(ForEachTest, SkipsTasksNotStartedAfterAFailure) {
  constexpr size_t kTasks = 1000000;
  std::atomic<size_t> started{0};
  EXPECT_THROW(runner_->ForEach(kTasks,
                                [&](size_t) {
                                  ++started;
                                  throw std::runtime_error("every task");
                                }),
               std::runtime_error);
  EXPECT_GE(started, 1u);
  EXPECT_LE(started, static_cast<size_t>(runner_->threads()));
}

TEST_P(ForEachTest, CanBeUsedAgainAfterAFailure) {
  EXPECT_THROW(runner_->ForEach(9, [](size_t) { throw 1; }), int);
  std::atomic<int> calls{0};
  runner_->ForEach(9, [&](size_t) { ++calls; });
  EXPECT_EQ(calls, 9);
}

TEST_P(ForEachTest, RunsNestedCallsOfTheSameRunner) {
  std::atomic<int> calls{0};
  runner_->ForEach(20, [&](size_t) {
    runner_->ForEach(20, [&](size_t) { runner_->ForEach(3, [&](size_t) { ++calls; }); });
  });
  EXPECT_EQ(calls, 20 * 20 * 3);
}

TEST_P(ForEachTest, PassesNestedFailuresOut) {
  EXPECT_THROW(runner_->ForEach(8,
                                [&](size_t) {
                                  runner_->ForEach(8, [](size_t i) {
                                    if (i == 5) throw std::out_of_range("inner");
                                  });
                                }),
               std::out_of_range);
}

// Were a waiting task to start another one of the outer call on its thread, that one would find the
// thread's flag raised (and, in real tasks, ask for a lock or memory that its own thread holds).
TEST_P(ForEachTest, StartsNoOuterTaskInsideAWaitingOne) {
  thread_local bool inside = false;
  std::atomic<int> entered_twice{0};
  runner_->ForEach(64, [&](size_t) {
    if (inside) ++entered_twice;
    inside = true;
    runner_->ForEach(16, [](size_t) { std::this_thread::yield(); });
    inside = false;
  });
  EXPECT_EQ(entered_twice, 0);
}

TEST(TbbRunnerTest, ThrowsTheFailureOfTheLowestIndexWhateverTheTiming) {
  const auto runner = MakeTbbRunner(8);
  for (int repeat = 0; repeat < 200; ++repeat) {
    try {
      runner->ForEach(64, [](size_t i) {
        if (i == 20) std::this_thread::sleep_for(std::chrono::microseconds(50));
        if (i >= 20) throw i;
      });
      FAIL() << "nothing was thrown";
    } catch (size_t index) {
      ASSERT_EQ(index, 20u);
    }
  }
}

TEST(TbbRunnerTest, HasTheThreadsThatWereAskedFor) {
  for (int threads : {1, 2, 3, 8}) EXPECT_EQ(MakeTbbRunner(threads)->threads(), threads);
}

// More tasks at once than the machine may have cores: each waits until all of them run.
TEST(TbbRunnerTest, RunsAsManyTasksAtOnceAsThreadsWereAskedFor) {
  constexpr int kThreads = 6;
  std::atomic<int> arrived{0};
  MakeTbbRunner(kThreads)->ForEach(kThreads, [&](size_t) {
    ++arrived;
    while (arrived < kThreads) std::this_thread::yield();
  });
  EXPECT_EQ(arrived, kThreads);
}

TEST(ShuffledRunnerTest, DrawsAnotherOrderForAnotherSeed) {
  std::set<std::vector<size_t>> orders;
  for (uint64_t seed = 0; seed < 8; ++seed) {
    std::vector<size_t> order;
    MakeShuffledRunner(seed)->ForEach(50, [&](size_t i) { order.push_back(i); });
    orders.insert(order);
  }
  EXPECT_EQ(orders.size(), 8u);
}

TEST(ShuffledRunnerTest, RepeatsTheOrderOfASeed) {
  std::vector<size_t> first;
  std::vector<size_t> second;
  MakeShuffledRunner(3)->ForEach(50, [&](size_t i) { first.push_back(i); });
  MakeShuffledRunner(3)->ForEach(50, [&](size_t i) { second.push_back(i); });
  EXPECT_EQ(first, second);
}

}  // namespace
}  // namespace folprom::parallel
