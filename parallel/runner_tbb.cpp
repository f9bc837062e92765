// Tasks on the threads of a oneTBB arena. The only place that knows oneTBB.
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>

#include "parallel/runner.h"

namespace folprom::parallel {
namespace {

// True while this thread is inside a task of any TbbRunner.
thread_local bool inside_task = false;

// oneTBB orders what one thread wrote before what another reads. Debian's oneTBB has no
// instrumentation, so a HandOver around each body says it where the thread sanitizer sees it.
std::atomic<size_t> handed_over{0};
void Publish() { handed_over.fetch_add(1); }
void Observe() { handed_over.load(); }
struct HandOver {
  HandOver() { Observe(); }
  ~HandOver() { Publish(); }
};

// The tasks of one call: hands the indices out in order and keeps the failure of the lowest one.
// Since all lower indices have started when one fails, and run to their end, which failure leaves
// does not depend on the threads.
class Job {
 public:
  explicit Job(size_t count) : count_(count) {}

  /// The next index, or the count when none is left or a lower one failed.
  size_t Claim() {
    const size_t index = next_.fetch_add(1);
    return index < std::min(count_, lowest_failed_.load()) ? index : count_;
  }

  /// One step of an index, unless this or a lower index failed.
  void Run(size_t index, const std::function<void(size_t)>& step) {
    if (index >= lowest_failed_.load()) return;
    const bool nested = std::exchange(inside_task, true);
    try {
      step(index);
    } catch (...) {
      KeepFailure(index, std::current_exception());
    }
    inside_task = nested;
  }

  void RethrowFailure() {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void KeepFailure(size_t index, std::exception_ptr failure) {
    const std::lock_guard lock(failure_mutex_);
    if (index >= lowest_failed_.load()) return;
    lowest_failed_.store(index);
    failure_ = std::move(failure);
  }

  const size_t count_;
  std::atomic<size_t> next_{0};
  std::atomic<size_t> lowest_failed_{std::numeric_limits<size_t>::max()};
  std::mutex failure_mutex_;
  std::exception_ptr failure_;
};

class TbbRunner final : public Runner {
 public:
  explicit TbbRunner(int threads)
      : threads_(threads > 0 ? threads : oneapi::tbb::info::default_concurrency()),
        arena_(threads_) {
    using oneapi::tbb::global_control;
    // oneTBB makes no more threads than the machine has unless told to.
    if (threads_ > oneapi::tbb::info::default_concurrency()) {
      more_threads_.emplace(global_control::max_allowed_parallelism, static_cast<size_t>(threads_));
    }
  }

  int threads() const override { return threads_; }

  void ForEach(size_t count, const std::function<void(size_t)>& task) override {
    Job job(count);
    const size_t slots = std::min(count, static_cast<size_t>(threads_));
    InArena([&] {
      oneapi::tbb::parallel_for(
          oneapi::tbb::blocked_range<size_t>(0, slots, 1),
          [&](const auto&) {
            const HandOver hand_over;
            for (size_t i = job.Claim(); i < count; i = job.Claim()) job.Run(i, task);
          },
          oneapi::tbb::simple_partitioner());
    });
    job.RethrowFailure();
  }

  void Ordered(size_t count, size_t window, const std::function<void(size_t)>& produce,
               const std::function<void(size_t)>& consume) override {
    using oneapi::tbb::filter_mode;
    using oneapi::tbb::make_filter;
    Job job(count);
    const auto claim = [&](oneapi::tbb::flow_control& control) {
      const HandOver hand_over;
      const size_t index = job.Claim();
      if (index == count) control.stop();
      return index;
    };
    const auto produce_one = [&](size_t index) {
      const HandOver hand_over;
      job.Run(index, produce);
      return index;
    };
    const auto consume_one = [&](size_t index) {
      const HandOver hand_over;
      job.Run(index, consume);
    };
    const auto steps = make_filter<void, size_t>(filter_mode::serial_in_order, claim) &
                       make_filter<size_t, size_t>(filter_mode::parallel, produce_one) &
                       make_filter<size_t, void>(filter_mode::serial_in_order, consume_one);
    const size_t at_once = std::max<size_t>(std::min(window, count), 1);
    InArena([&] { oneapi::tbb::parallel_pipeline(at_once, steps); });
    job.RethrowFailure();
  }

 private:
  // A nested call is isolated: while it waits, its thread takes no other task of the outer call,
  // which could ask for the memory or the lock that the waiting task holds.
  template <class Work>
  void InArena(const Work& work) {
    Publish();
    if (inside_task) {
      arena_.execute([&] { oneapi::tbb::this_task_arena::isolate(work); });
    } else {
      arena_.execute(work);
    }
    Observe();
  }

  const int threads_;
  std::optional<oneapi::tbb::global_control> more_threads_;
  oneapi::tbb::task_arena arena_;
};

}  // namespace

std::unique_ptr<Runner> MakeTbbRunner(int threads) { return std::make_unique<TbbRunner>(threads); }

}  // namespace folprom::parallel
