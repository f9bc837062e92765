// How far a batch is, on standard error.
#pragma once

#include <chrono>
#include <string>

#include "apps/batch/run.h"

namespace folprom::batch {

enum class DisplayMode : uint8_t { kNone, kText, kJson };

/// On a terminal two live lines: all scans, and what runs. Elsewhere one line every ten seconds. As
/// JSON: one object a line, at once and each second. No thread of its own.
class BatchDisplay {
 public:
  explicit BatchDisplay(DisplayMode mode);
  ~BatchDisplay() { Clear(); }
  BatchDisplay(const BatchDisplay&) = delete;
  BatchDisplay& operator=(const BatchDisplay&) = delete;

  void Show(const BatchReading& reading);
  /// Takes the live lines away, so that something else can be printed.
  void Clear();

 private:
  void ShowLive(const BatchReading& reading);

  const DisplayMode mode_;
  const bool terminal_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  bool begun_ = false;
  bool shown_ = false;  ///< the live lines are
};

/// "12 of 340 scans  35 %  180.0 k vertices/s  0:40 left  1.2 GiB", with "  1 failed".
std::string TextOf(const BatchReading& reading);
/// "encode a.ply: encode  42 %  ...", and "  and 3 more".
std::string RunningText(const BatchReading& reading);
Json JsonOf(const BatchReading& reading);

}  // namespace folprom::batch
