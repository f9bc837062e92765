// Shows a Progress on standard error while a verb works.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "parallel/progress.h"

namespace folprom::cli {

/// On a terminal one live line: stage, percent, rate, time left, memory. Elsewhere a plain line
/// every ten seconds. As JSON: one object a line, each second, as each stage begins, and at the
/// end. Reads the progress every 200 ms on a thread of its own, which ends with the object.
class ProgressDisplay {
 public:
  /// `progress` must outlive the display. `verbose`: also a line for each stage.
  ProgressDisplay(const parallel::Progress& progress, bool verbose, bool json);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

 private:
  void Run();
  void RunText();
  void RunJson();
  /// Sleeps for a period. False when the display ends. `lock` holds mutex_.
  bool Wait(std::unique_lock<std::mutex>& lock);

  const parallel::Progress& progress_;
  const bool verbose_;
  const bool json_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stop_ = false;
  std::thread thread_;
};

/// Whether colour may be used on standard error: a terminal, and NO_COLOR is not set.
bool ColourWanted();

}  // namespace folprom::cli
