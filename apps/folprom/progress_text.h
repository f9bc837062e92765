// How far a job is, as a line for a reader or as an object for a program.
#pragma once

#include <chrono>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "parallel/progress.h"

namespace folprom::cli {

/// One look at a stage.
struct ProgressReading {
  std::string stage;
  std::string unit;  ///< what is counted, where its rate says something; else empty
  uint64_t done = 0;
  uint64_t total = 0;         ///< 0: not known
  double seconds = 0;         ///< since the stage began
  uint64_t memory_bytes = 0;  ///< resident now; 0: not known

  std::optional<double> fraction() const;      ///< 0 .. 1
  std::optional<double> per_second() const;    ///< of `unit`
  std::optional<double> seconds_left() const;  ///< of the stage, at the mean rate so far
};

/// Tells when a stage of a Progress began.
class StageClock {
 public:
  /// `memory_bytes` is passed on.
  ProgressReading Read(const parallel::Progress& progress, uint64_t memory_bytes);

 private:
  std::string stage_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// "encode  42 %  180.0 k vertices/s  0:12 left  1.2 GiB"
std::string ProgressText(const ProgressReading& reading);
/// The fields of ProgressReading; null for what is not known.
nlohmann::ordered_json ProgressJson(const ProgressReading& reading);
/// "180.0 k"
std::string RateText(double per_second);
/// "1:02:03" or "2:03"
std::string TimeText(double seconds);

}  // namespace folprom::cli
