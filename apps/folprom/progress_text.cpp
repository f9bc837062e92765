#include "apps/folprom/progress_text.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "apps/folprom/report.h"

namespace folprom::cli {

std::optional<double> ProgressReading::fraction() const {
  if (total == 0) return std::nullopt;
  return std::min(1.0, static_cast<double>(done) / static_cast<double>(total));
}

std::optional<double> ProgressReading::per_second() const {
  if (unit.empty() || done == 0 || seconds <= 0) return std::nullopt;
  return static_cast<double>(done) / seconds;
}

std::optional<double> ProgressReading::seconds_left() const {
  if (done == 0 || total == 0 || seconds <= 0) return std::nullopt;
  const uint64_t left = total - std::min(done, total);
  return seconds * static_cast<double>(left) / static_cast<double>(done);
}

ProgressReading StageClock::Read(const parallel::Progress& progress, uint64_t memory_bytes) {
  const auto now = std::chrono::steady_clock::now();
  ProgressReading reading;
  reading.stage = progress.stage();
  if (reading.stage != stage_) {
    stage_ = reading.stage;
    begin_ = now;
  }
  reading.unit = progress.unit();
  reading.done = progress.done();
  reading.total = progress.total();
  reading.seconds = std::chrono::duration<double>(now - begin_).count();
  reading.memory_bytes = memory_bytes;
  return reading;
}

std::string ProgressText(const ProgressReading& reading) {
  std::string line = reading.stage;
  if (const auto fraction = reading.fraction()) line += fmt::format("  {:.0f} %", 100 * *fraction);
  if (const auto rate = reading.per_second()) {
    line += fmt::format("  {} {}/s", RateText(*rate), reading.unit);
  }
  if (const auto left = reading.seconds_left()) line += "  " + TimeText(*left) + " left";
  if (reading.memory_bytes > 0) line += "  " + BytesShort(reading.memory_bytes);
  return line;
}

Json ProgressJson(const ProgressReading& reading) {
  return {{"stage", reading.stage},
          {"done", reading.done},
          {"total", reading.total},
          {"unit", reading.unit},
          {"fraction", OrNull(reading.fraction())},
          {"per_second", OrNull(reading.per_second())},
          {"seconds_left", OrNull(reading.seconds_left())},
          {"seconds", reading.seconds},
          {"memory_bytes", reading.memory_bytes}};
}

std::string RateText(double per_second) {
  if (per_second >= 1e6) return fmt::format("{:.1f} M", per_second / 1e6);
  if (per_second >= 1e3) return fmt::format("{:.1f} k", per_second / 1e3);
  return fmt::format("{:.1f}", per_second);
}

std::string TimeText(double seconds) {
  const auto whole = static_cast<long>(seconds + 0.5);
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace folprom::cli
