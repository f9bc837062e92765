#include "apps/folprom/progress_display.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

namespace folprom::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kPeriod = std::chrono::milliseconds(200);
constexpr auto kPlainPeriod = std::chrono::seconds(10);

double SecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::string RateText(double per_second) {
  if (per_second >= 1e6) return fmt::format("{:.1f} M/s", per_second / 1e6);
  if (per_second >= 1e3) return fmt::format("{:.1f} k/s", per_second / 1e3);
  return fmt::format("{:.1f} /s", per_second);
}

std::string TimeText(double seconds) {
  const auto whole = static_cast<long>(seconds + 0.5);
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

// One reading of the progress.
struct Reading {
  std::string stage;
  double done = 0;
  double total = 0;
};

std::string LineText(const Reading& reading, double seconds) {
  std::string line = reading.stage;
  if (reading.total > 0) {
    line += fmt::format("  {:.0f} %", 100 * std::min(1.0, reading.done / reading.total));
  }
  if (reading.done > 0 && seconds > 0) {
    const double rate = reading.done / seconds;
    line += "  " + RateText(rate);
    if (reading.done < reading.total) {
      line += "  " + TimeText((reading.total - reading.done) / rate) + " left";
    }
  }
  return line;
}

}  // namespace

bool ColourWanted() {
  const char* no_colour = std::getenv("NO_COLOR");
  return isatty(STDERR_FILENO) != 0 && (no_colour == nullptr || *no_colour == '\0');
}

ProgressDisplay::ProgressDisplay(const parallel::Progress& progress, bool verbose)
    : progress_(progress), verbose_(verbose), thread_([this] { Run(); }) {}

ProgressDisplay::~ProgressDisplay() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void ProgressDisplay::Run() {
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const std::string_view colour = ColourWanted() ? "\033[36m" : "";
  const std::string_view plain = ColourWanted() ? "\033[0m" : "";
  std::string stage;
  Clock::time_point stage_begin = Clock::now();
  Clock::time_point last_line = Clock::now();
  bool line_shown = false;
  const auto clear_line = [&] {
    if (line_shown) fmt::print(stderr, "\r\033[K");
    line_shown = false;
  };

  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, kPeriod, [this] { return stop_; })) {
    const Reading reading{progress_.stage(), static_cast<double>(progress_.done()),
                          static_cast<double>(progress_.total())};
    if (reading.stage.empty()) continue;
    if (reading.stage != stage) {
      clear_line();
      stage = reading.stage;
      stage_begin = Clock::now();
      if (verbose_) spdlog::debug("stage: {}", stage);
    }
    const std::string line = LineText(reading, SecondsSince(stage_begin));
    if (terminal) {
      fmt::print(stderr, "\r{}{}{}\033[K", colour, line, plain);
      line_shown = true;
    } else if (Clock::now() - last_line >= kPlainPeriod) {
      fmt::print(stderr, "folprom: {}\n", line);
      last_line = Clock::now();
    }
    std::fflush(stderr);
  }
  clear_line();
  std::fflush(stderr);
}

}  // namespace folprom::cli
