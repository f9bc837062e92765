// Shows a Progress on standard error while a verb works.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "parallel/progress.h"

namespace folprom::cli {

/// On a terminal one live line: stage, percent, rate, time left. Elsewhere a plain line every ten
/// seconds. Reads the progress every 200 ms on a thread of its own, which ends with the object.
class ProgressDisplay {
 public:
  /// `progress` must outlive the display. `verbose`: also a line for each stage.
  ProgressDisplay(const parallel::Progress& progress, bool verbose);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

 private:
  void Run();

  const parallel::Progress& progress_;
  const bool verbose_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stop_ = false;
  std::thread thread_;
};

/// Whether colour may be used on standard error: a terminal, and NO_COLOR is not set.
bool ColourWanted();

}  // namespace folprom::cli
