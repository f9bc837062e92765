#include "parallel/memory_budget.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <utility>
#include <vector>

#include "parallel/runner.h"

namespace folprom::parallel {
namespace {

TEST(MemoryBudgetTest, CountsWhatIsOut) {
  MemoryBudget budget(100);
  EXPECT_EQ(budget.in_use(), 0u);
  {
    const auto first = budget.Acquire(30);
    const auto second = budget.Acquire(70);
    EXPECT_EQ(budget.in_use(), 100u);
  }
  EXPECT_EQ(budget.in_use(), 0u);
}

TEST(MemoryBudgetTest, ReleasesOnceHoweverTheLeaseMoves) {
  MemoryBudget budget(100);
  auto lease = budget.Acquire(40);
  MemoryBudget::Lease moved(std::move(lease));
  EXPECT_EQ(budget.in_use(), 40u);
  auto other = budget.Acquire(50);
  moved = std::move(other);  // gives the 40 back
  EXPECT_EQ(budget.in_use(), 50u);
  moved.Release();
  moved.Release();
  EXPECT_EQ(budget.in_use(), 0u);
}

TEST(MemoryBudgetTest, GrantsAnOversizedRequestWhenNothingElseIsOut) {
  MemoryBudget budget(100);
  const auto lease = budget.Acquire(1000);
  EXPECT_EQ(budget.in_use(), 1000u);
}

TEST(MemoryBudgetTest, GrantsALimitOfZeroOneAtATime) {
  MemoryBudget budget(0);
  { const auto lease = budget.Acquire(5); }
  const auto lease = budget.Acquire(6);
  EXPECT_EQ(budget.in_use(), 6u);
}

TEST(MemoryBudgetTest, RunsOversizedRequestsAlone) {
  constexpr uint64_t kLimit = 100;
  MemoryBudget budget(kLimit);
  std::atomic<int> running{0};
  std::atomic<int> shared_with_oversized{0};
  MakeTbbRunner(8)->ForEach(400, [&](size_t i) {
    const bool oversized = i % 7 == 0;
    const auto lease = budget.Acquire(oversized ? kLimit + 1 : 10 + i % 40);
    const int now = ++running;
    if (oversized && now > 1) ++shared_with_oversized;
    std::this_thread::yield();
    if (oversized && running > 1) ++shared_with_oversized;
    --running;
  });
  EXPECT_EQ(shared_with_oversized, 0);
  EXPECT_EQ(budget.in_use(), 0u);
}

TEST(MemoryBudgetTest, NeverGivesOutMoreThanTheLimit) {
  constexpr uint64_t kLimit = 64;
  MemoryBudget budget(kLimit);
  std::atomic<uint64_t> out{0};
  std::atomic<bool> exceeded{false};
  std::vector<std::thread> threads;
  for (uint64_t t = 0; t < 16; ++t) {
    threads.emplace_back([&, t] {
      for (uint64_t i = 0; i < 500; ++i) {
        const uint64_t bytes = (t * 31 + i * 17) % (kLimit + 1);
        const auto lease = budget.Acquire(bytes);
        if (out.fetch_add(bytes) + bytes > kLimit) exceeded = true;
        out.fetch_sub(bytes);
      }
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_FALSE(exceeded);
  EXPECT_EQ(budget.in_use(), 0u);
}

// Small requests that never leave a gap: served out of turn, they would keep the large one waiting.
TEST(MemoryBudgetTest, ServesALargeRequestAmongEndlessSmallOnes) {
  MemoryBudget budget(100);
  std::atomic<bool> large_served{false};
  std::atomic<int> small_started{0};
  std::vector<std::thread> small;
  for (int t = 0; t < 3; ++t) {
    small.emplace_back([&] {
      auto lease = budget.Acquire(1);
      ++small_started;
      while (!large_served) {
        lease.Release();
        lease = budget.Acquire(1);
      }
    });
  }
  while (small_started < 3) std::this_thread::yield();
  {
    const auto lease = budget.Acquire(100);
    large_served = true;
  }
  for (auto& thread : small) thread.join();
  EXPECT_EQ(budget.in_use(), 0u);
}

TEST(MemoryBudgetTest, GivesTheBytesBackWhenATaskThrows) {
  MemoryBudget budget(100);
  EXPECT_THROW(MakeTbbRunner(4)->ForEach(50,
                                         [&](size_t i) {
                                           const auto lease = budget.Acquire(60);
                                           if (i == 10) throw 10;
                                         }),
               int);
  EXPECT_EQ(budget.in_use(), 0u);
}

TEST(MemoryBudgetTest, LetsTasksThatHoldMemoryRunNestedWork) {
  MemoryBudget budget(100);
  const auto runner = MakeTbbRunner(4);
  std::atomic<int> calls{0};
  runner->ForEach(60, [&](size_t) {
    const auto lease = budget.Acquire(80);
    runner->ForEach(10, [&](size_t) { ++calls; });
  });
  EXPECT_EQ(calls, 600);
}

}  // namespace
}  // namespace folprom::parallel
