#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <memory>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "tests/unit/parallel/runners.h"

namespace folprom::parallel {
namespace {

using OrderedTest = EachRunner;
INSTANTIATE_TEST_SUITE_P(Runners, OrderedTest, testing::ValuesIn(AllRunners()), RunnerName);

TEST_P(OrderedTest, ProducesEachIndexOnceAndConsumesInOrder) {
  constexpr size_t kCount = 3000;
  std::vector<std::unique_ptr<size_t>> results(kCount);
  std::vector<std::atomic<int>> produced(kCount);
  std::vector<size_t> consumed;
  runner_->Ordered(
      kCount, 7,
      [&](size_t i) {
        ++produced[i];
        results[i] = std::make_unique<size_t>(i * 3);
      },
      [&](size_t i) {
        ASSERT_NE(results[i], nullptr);
        consumed.push_back(*results[i]);
        results[i].reset();
      });
  ASSERT_EQ(consumed.size(), kCount);
  for (size_t i = 0; i < kCount; ++i) {
    EXPECT_EQ(produced[i], 1);
    EXPECT_EQ(consumed[i], i * 3);
  }
}

TEST_P(OrderedTest, CallsNothingForZeroTasks) {
  runner_->Ordered(
      0, 4, [](size_t) { FAIL(); }, [](size_t) { FAIL(); });
}

TEST_P(OrderedTest, KeepsTheWindow) {
  for (size_t window : {1, 2, 5, 100}) {
    std::atomic<size_t> open{0};
    std::atomic<size_t> most{0};
    runner_->Ordered(
        300, window,
        [&](size_t) {
          const size_t now = ++open;
          size_t seen = most;
          while (seen < now && !most.compare_exchange_weak(seen, now)) {
          }
          std::this_thread::yield();
        },
        [&](size_t) { --open; });
    EXPECT_LE(most, window);
    EXPECT_EQ(open, 0u);
  }
}

TEST_P(OrderedTest, TakesAWindowOfZeroAsOne) {
  std::vector<size_t> consumed;
  runner_->Ordered(
      5, 0, [](size_t) {}, [&](size_t i) { consumed.push_back(i); });
  EXPECT_EQ(consumed, (std::vector<size_t>{0, 1, 2, 3, 4}));
}

TEST_P(OrderedTest, TakesAWindowLargerThanTheCount) {
  size_t sum = 0;
  runner_->Ordered(
      100, std::numeric_limits<size_t>::max(), [](size_t) {}, [&](size_t i) { sum += i; });
  EXPECT_EQ(sum, 4950u);
}

TEST_P(OrderedTest, NeverConsumesTwoAtOnce) {
  std::atomic<int> consuming{0};
  bool overlapped = false;
  runner_->Ordered(
      500, 16, [](size_t) {},
      [&](size_t) {
        if (++consuming > 1) overlapped = true;
        std::this_thread::yield();
        --consuming;
      });
  EXPECT_FALSE(overlapped);
}

TEST_P(OrderedTest, RethrowsWhatProduceThrewAndConsumesNothingAfterIt) {
  std::vector<size_t> consumed;
  try {
    runner_->Ordered(
        100, 4,
        [](size_t i) {
          if (i == 30) throw std::runtime_error("produce 30");
        },
        [&](size_t i) { consumed.push_back(i); });
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "produce 30");
  }
  EXPECT_LE(consumed.size(), 30u);
  for (size_t i = 0; i < consumed.size(); ++i) EXPECT_EQ(consumed[i], i);
}

TEST_P(OrderedTest, RethrowsWhatConsumeThrewAndConsumesNothingAfterIt) {
  size_t consumed = 0;
  EXPECT_THROW(runner_->Ordered(
                   100, 4, [](size_t) {},
                   [&](size_t i) {
                     if (i == 30) throw std::length_error("consume 30");
                     ++consumed;
                   }),
               std::length_error);
  EXPECT_EQ(consumed, 30u);
}

TEST_P(OrderedTest, StartsNothingBeyondTheWindowAfterAFailure) {
  std::atomic<size_t> highest{0};
  EXPECT_THROW(runner_->Ordered(
                   1000000, 10,
                   [&](size_t i) {
                     size_t seen = highest;
                     while (seen < i && !highest.compare_exchange_weak(seen, i)) {
                     }
                     if (i == 50) throw std::runtime_error("produce 50");
                   },
                   [](size_t) {}),
               std::runtime_error);
  EXPECT_LT(highest, 60u);
}

TEST_P(OrderedTest, RunsNestedCallsInBothSteps) {
  std::atomic<int> calls{0};
  const auto nested = [&](size_t) { runner_->ForEach(5, [&](size_t) { ++calls; }); };
  runner_->Ordered(40, 4, nested, nested);
  EXPECT_EQ(calls, 40 * 2 * 5);
}

TEST_P(OrderedTest, RunsInsideATaskOfForEach) {
  std::vector<std::vector<size_t>> consumed(12);
  runner_->ForEach(consumed.size(), [&](size_t task) {
    runner_->Ordered(
        10, 3, [](size_t) {}, [&](size_t i) { consumed[task].push_back(i); });
  });
  std::vector<size_t> in_order(10);
  std::iota(in_order.begin(), in_order.end(), size_t{0});
  for (const auto& order : consumed) EXPECT_EQ(order, in_order);
}

TEST(TbbOrderedTest, ThrowsTheSerialFailureAfterConsumingAllBelowIt) {
  const auto runner = MakeTbbRunner(8);
  for (int repeat = 0; repeat < 200; ++repeat) {
    size_t consumed = 0;
    try {
      runner->Ordered(
          64, 8,
          [](size_t i) {
            if (i >= 20) throw i;
            if (i == 19) std::this_thread::sleep_for(std::chrono::microseconds(50));
          },
          [&](size_t) { ++consumed; });
      FAIL() << "nothing was thrown";
    } catch (size_t index) {
      ASSERT_EQ(index, 20u);
      ASSERT_EQ(consumed, 20u);
    }
  }
}

TEST(ShuffledOrderedTest, ProducesOutOfOrderInsideTheWindow) {
  std::vector<size_t> produced;
  MakeShuffledRunner(1)->Ordered(
      64, 8, [&](size_t i) { produced.push_back(i); }, [](size_t) {});
  EXPECT_FALSE(std::is_sorted(produced.begin(), produced.end()));
  EXPECT_EQ(std::set<size_t>(produced.begin(), produced.end()).size(), 64u);
}

}  // namespace
}  // namespace folprom::parallel
