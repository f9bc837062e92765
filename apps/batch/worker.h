// A process of its own for one operation: its memory is its own, and its death is nobody else's.
#pragma once

#include <sys/types.h>

#include <memory>
#include <optional>
#include <string>

#include "apps/batch/task.h"
#include "apps/folprom/progress_text.h"
#include "io/files/posix.h"
#include "parallel/progress.h"

namespace folprom::batch {

/// Runs a task in a child process. The caller must have no other threads. A child whose parent dies
/// cancels its work and leaves nothing.
class Worker {
 public:
  /// Throws Failure kLimit where the system gives no process.
  Worker(Plan* plan, size_t task, const Share& share);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  size_t task() const { return task_; }
  const Share& share() const { return share_; }
  pid_t process() const { return process_; }
  /// To poll for reading.
  int descriptor() const { return pipe_.get(); }
  void Cancel() { progress_->Cancel(); }
  cli::ProgressReading Progress();

  /// Takes what has come. True once the child has said all.
  bool Receive();
  /// After Receive gave true: waits for the child to end. A child that died by itself makes a
  /// result that failed.
  Outcome Finish(const Plan& plan);

 private:
  [[noreturn]] void RunChild(Plan* plan, int descriptor, pid_t parent);

  const size_t task_;
  const Share share_;
  struct Unmap {
    void operator()(parallel::Progress* progress) const;
  };
  const std::unique_ptr<parallel::Progress, Unmap> progress_;  ///< shared with the child
  cli::StageClock clock_;
  pid_t process_ = -1;
  io::Descriptor pipe_;
  std::string message_;
};

}  // namespace folprom::batch
