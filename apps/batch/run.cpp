#include "apps/batch/run.h"

#include <poll.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "apps/batch/task.h"
#include "apps/batch/worker.h"
#include "apps/folprom/session.h"

namespace folprom::batch {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kPollMilliseconds = 100;

// The next operation of a scan.
struct Waiting {
  size_t scan = 0;
  size_t step = 0;  ///< in Scan::tasks
};

class BatchRun {
 public:
  BatchRun(Plan* plan, const Budget& budget, const parallel::Progress& cancel, Observer& observer)
      : plan_(*plan), budget_(budget), cancel_(cancel), observer_(observer) {
    for (const Task& task : plan_.tasks) results_.push_back(plan_.ResultOf(task));
    for (size_t scan = 0; scan < plan_.scans.size(); ++scan) {
      waiting_.push_back({scan, 0});
      left_bytes_ += plan_.scans[scan].bytes * plan_.scans[scan].tasks.size();
    }
    // Large ones first, so that no core waits for them at the end.
    std::stable_sort(waiting_.begin(), waiting_.end(), [&](const Waiting& a, const Waiting& b) {
      return plan_.scans[a.scan].bytes > plan_.scans[b.scan].bytes;
    });
  }

  std::vector<OperationResult> Run() {
    while (true) {
      if (cancel_.cancelled()) Stop("interrupted");
      StartWhatFits();
      if (workers_.empty()) break;
      Receive();
      observer_.Tick(Reading());
    }
    for (size_t task = 0; task < results_.size(); ++task) {
      if (!ended_.contains(task)) SetNotRun(task, stop_reason_);
    }
    return std::move(results_);
  }

 private:
  void Stop(const std::string& reason) {
    if (stop_reason_.empty()) stop_reason_ = reason;
    if (!cancel_.cancelled()) return;
    for (const auto& worker : workers_) worker->Cancel();
  }

  void StartWhatFits() {
    for (size_t i = 0; i < waiting_.size() && stop_reason_.empty();) {
      if (cancel_.cancelled()) return;
      if (Start(waiting_[i])) {
        waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(i));
      } else {
        ++i;
      }
    }
  }

  // False where it has to wait. Steps over what is up to date.
  bool Start(Waiting& next) {
    const Scan& scan = plan_.scans[next.scan];
    for (; next.step < scan.tasks.size() && stop_reason_.empty(); ++next.step) {
      const size_t index = scan.tasks[next.step];
      const Task& task = plan_.tasks[index];
      if (LacksItsInput(index)) {
        SetNotRun(index, "encode failed");
        continue;
      }
      const Finding finding = Look(plan_, task);
      if (finding.verdict == Verdict::kUpToDate) {
        End(index, UpToDate(plan_, task, finding));
        continue;
      }
      const auto share = budget_.Take(NeedOf(plan_, task, budget_.threads()));
      if (!share) return false;
      workers_.push_back(std::make_unique<Worker>(&plan_, index, *share));
      plan_.LedgerOf(task).Begin(task.key, workers_.back()->process());
      return true;
    }
    return true;
  }

  bool LacksItsInput(size_t index) const {
    const Task& task = plan_.tasks[index];
    const bool of_folp =
        task.operation == Operation::kDecode || task.operation == Operation::kVerify;
    if (!of_folp) return false;
    const size_t first = plan_.scans[task.scan].tasks.front();
    return results_[first].operation == Operation::kEncode &&
           results_[first].status != Status::kDone && results_[first].status != Status::kUpToDate;
  }

  void Receive() {
    std::vector<pollfd> descriptors;
    for (const auto& worker : workers_) descriptors.push_back({worker->descriptor(), POLLIN, 0});
    ::poll(descriptors.data(), descriptors.size(), kPollMilliseconds);
    for (size_t i = workers_.size(); i-- > 0;) {
      if (descriptors[i].revents == 0 || !workers_[i]->Receive()) continue;
      const std::unique_ptr<Worker> worker = std::move(workers_[i]);
      workers_.erase(workers_.begin() + static_cast<std::ptrdiff_t>(i));
      budget_.GiveBack(worker->share());
      End(worker->task(), worker->Finish(plan_));
      QueueNextOf(worker->task());
    }
  }

  void QueueNextOf(size_t index) {
    const Scan& scan = plan_.scans[plan_.tasks[index].scan];
    const auto at = std::find(scan.tasks.begin(), scan.tasks.end(), index);
    const size_t step = static_cast<size_t>(at - scan.tasks.begin()) + 1;
    // At the front: a scan that was begun is finished first.
    if (step < scan.tasks.size()) {
      waiting_.insert(waiting_.begin(), {plan_.tasks[index].scan, step});
    }
  }

  void End(size_t index, const Outcome& outcome) {
    const Task& task = plan_.tasks[index];
    results_[index] = outcome.result;
    if (outcome.record) {
      const Record* known = plan_.LedgerOf(task).Find(task.key);
      const bool is_new = known == nullptr || outcome.result.status == Status::kDone ||
                          !SameStamps(*known, *outcome.record);
      if (is_new) plan_.LedgerOf(task).Done(task.key, *outcome.record);
      for (const KnownFile& file : outcome.record->inputs) plan_.hashes.Remember(file);
      for (const KnownFile& file : outcome.record->outputs) plan_.hashes.Remember(file);
    }
    Tell(index);
    const bool failed = outcome.result.status == Status::kFailed;
    if (failed && plan_.JobOf(task).on_error == "stop") {
      Stop("stopped after a failure, for on_error = \"stop\"");
    }
  }

  static bool SameStamps(const Record& a, const Record& b) {
    const auto same = [](const std::vector<KnownFile>& x, const std::vector<KnownFile>& y) {
      return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                        [](const KnownFile& f, const KnownFile& g) { return f.stamp == g.stamp; });
    };
    return same(a.inputs, b.inputs) && same(a.outputs, b.outputs);
  }

  void SetNotRun(size_t index, const std::string& reason) {
    results_[index].status = Status::kNotRun;
    results_[index].reason = reason;
    Tell(index);
  }

  void Tell(size_t index) {
    ended_.insert(index);
    const OperationResult& result = results_[index];
    const uint64_t bytes = plan_.scans[plan_.tasks[index].scan].bytes;
    if (result.status == Status::kUpToDate || result.status == Status::kNotRun) {
      left_bytes_ -= bytes;
    } else {
      done_bytes_ += bytes;
      done_vertices_ += result.vertices;
    }
    observer_.Ended(result);
  }

  BatchReading Reading() {
    BatchReading reading;
    const ScanCounts counts = CountScans(plan_, results_);
    reading.scans = plan_.scans.size();
    reading.scans_done = counts.done;
    reading.scans_failed = counts.failed;
    reading.seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
    reading.memory_bytes = cli::ResidentBytes();
    auto done = static_cast<double>(done_bytes_), vertices = static_cast<double>(done_vertices_);
    for (const auto& worker : workers_) {
      const Task& task = plan_.tasks[worker->task()];
      const Scan& scan = plan_.scans[task.scan];
      const cli::ProgressReading progress = worker->Progress();
      reading.memory_bytes += progress.memory_bytes;
      done += static_cast<double>(scan.bytes) * progress.fraction().value_or(0);
      // The stage that takes nearly all of the time is counted in vertices.
      if (progress.unit == "vertices") vertices += static_cast<double>(progress.done);
      reading.running.push_back({plan_.JobOf(task).name, scan.name, task.operation, progress});
    }
    if (left_bytes_ > 0) fraction_ = std::max(fraction_, done / static_cast<double>(left_bytes_));
    reading.fraction = std::min(1.0, fraction_);
    if (reading.fraction > 0) {
      reading.seconds_left = reading.seconds * (1 - reading.fraction) / reading.fraction;
    }
    if (reading.seconds > 0) reading.vertices_per_second = vertices / reading.seconds;
    return reading;
  }

  Plan& plan_;
  Budget budget_;
  const parallel::Progress& cancel_;
  Observer& observer_;
  const Clock::time_point begin_ = Clock::now();
  std::vector<Waiting> waiting_;  ///< in the order in which they may start
  std::vector<std::unique_ptr<Worker>> workers_;
  std::vector<OperationResult> results_;
  std::set<size_t> ended_;
  std::string stop_reason_;  ///< nothing starts any more
  uint64_t left_bytes_ = 0;  ///< to read in this run, those already read included
  uint64_t done_bytes_ = 0;
  uint64_t done_vertices_ = 0;
  double fraction_ = 0;  ///< never falls, though each stage of an operation begins anew
};

}  // namespace

std::vector<OperationResult> RunPlan(Plan* plan, Budget budget, const parallel::Progress& cancel,
                                     Observer& observer) {
  return BatchRun(plan, budget, cancel, observer).Run();
}

ScanCounts CountScans(const Plan& plan, const std::vector<OperationResult>& results) {
  ScanCounts counts;
  for (const Scan& scan : plan.scans) {
    const auto is = [&](auto... statuses) {
      return [&results, statuses...](size_t task) {
        return ((results[task].status == statuses) || ...);
      };
    };
    counts.done +=
        std::all_of(scan.tasks.begin(), scan.tasks.end(), is(Status::kDone, Status::kUpToDate));
    counts.failed += std::any_of(scan.tasks.begin(), scan.tasks.end(), is(Status::kFailed));
  }
  return counts;
}

}  // namespace folprom::batch
