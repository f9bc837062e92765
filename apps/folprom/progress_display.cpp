#include "apps/folprom/progress_display.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "apps/folprom/progress_text.h"
#include "apps/folprom/session.h"

namespace folprom::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kPeriod = std::chrono::milliseconds(200);
constexpr auto kJsonPeriod = std::chrono::seconds(1);
constexpr auto kPlainPeriod = std::chrono::seconds(10);

}  // namespace

bool ColourWanted() {
  const char* no_colour = std::getenv("NO_COLOR");
  return isatty(STDERR_FILENO) != 0 && (no_colour == nullptr || *no_colour == '\0');
}

ProgressDisplay::ProgressDisplay(const parallel::Progress& progress, bool verbose, bool json)
    : progress_(progress), verbose_(verbose), json_(json), thread_([this] { Run(); }) {}

ProgressDisplay::~ProgressDisplay() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

bool ProgressDisplay::Wait(std::unique_lock<std::mutex>& lock) {
  return !wake_.wait_for(lock, kPeriod, [this] { return stop_; });
}

void ProgressDisplay::Run() {
  if (json_) {
    RunJson();
  } else {
    RunText();
  }
}

void ProgressDisplay::RunJson() {
  StageClock clock;
  std::string stage;
  Clock::time_point last_line = Clock::now();
  const auto print = [](const ProgressReading& reading) {
    fmt::print(stderr, "{}\n", ProgressJson(reading).dump());
    std::fflush(stderr);
  };
  std::unique_lock lock(mutex_);
  while (Wait(lock)) {
    const ProgressReading reading = clock.Read(progress_, ResidentBytes());
    if (reading.stage.empty()) continue;
    if (reading.stage == stage && Clock::now() - last_line < kJsonPeriod) continue;
    stage = reading.stage;
    last_line = Clock::now();
    print(reading);
  }
  print(clock.Read(progress_, ResidentBytes()));
}

void ProgressDisplay::RunText() {
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const std::string_view colour = ColourWanted() ? "\033[36m" : "";
  const std::string_view plain = ColourWanted() ? "\033[0m" : "";
  StageClock clock;
  std::string stage;
  Clock::time_point last_line = Clock::now();
  bool line_shown = false;
  const auto clear_line = [&] {
    if (line_shown) fmt::print(stderr, "\r\033[K");
    line_shown = false;
  };

  std::unique_lock lock(mutex_);
  while (Wait(lock)) {
    const ProgressReading reading = clock.Read(progress_, ResidentBytes());
    if (reading.stage.empty()) continue;
    if (reading.stage != stage) {
      clear_line();
      stage = reading.stage;
      if (verbose_) spdlog::debug("stage: {}", stage);
    }
    const std::string line = ProgressText(reading);
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
