// What surrounds the work of every verb: clock, log, signals, progress.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "apps/folprom/options.h"
#include "apps/folprom/progress_display.h"
#include "parallel/progress.h"

namespace folprom::cli {

/// Lives while a verb works. SIGINT, SIGTERM and SIGHUP cancel its progress; a second one ends the
/// program at once. SIGXFSZ is ignored, so that writing fails instead. One at a time.
class Session {
 public:
  explicit Session(const CommonFlags& flags);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  parallel::Progress& progress() { return progress_; }
  /// Ends the live line, so that a summary can be printed.
  void StopDisplay() { display_.reset(); }
  /// Seconds since the session began.
  double seconds() const;

 private:
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  parallel::Progress progress_;
  std::unique_ptr<ProgressDisplay> display_;
};

/// From now on the signals of a Session cancel this progress, SIGTERM however often: in the child of
/// a fork.
void CancelOnSignals(parallel::Progress* progress);

/// Resident size of a process now, 0 for this one, bytes; 0 where the system does not tell.
uint64_t ResidentBytes(pid_t process = 0);
/// Largest resident size of this process so far, bytes.
uint64_t PeakResidentBytes();

/// Sends warnings to the log, one line each.
void LogWarnings(const std::vector<std::string>& warnings);

}  // namespace folprom::cli
