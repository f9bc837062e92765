#include "apps/batch/batch_display.h"

#include <spdlog/fmt/fmt.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "apps/folprom/progress_display.h"
#include "apps/folprom/report.h"

namespace folprom::batch {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kLivePeriod = std::chrono::milliseconds(200);
constexpr auto kJsonPeriod = std::chrono::seconds(1);
constexpr auto kPlainPeriod = std::chrono::seconds(10);

// A line that wraps could not be taken away.
std::string Fitting(const std::string& line) {
  winsize size = {};
  const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return line.substr(0, known ? size.ws_col - 1U : 79U);
}

}  // namespace

BatchDisplay::BatchDisplay(DisplayMode mode)
    : mode_(mode), terminal_(::isatty(STDERR_FILENO) != 0) {}

void BatchDisplay::Show(const BatchReading& reading) {
  if (mode_ == DisplayMode::kNone) return;
  const bool json = mode_ == DisplayMode::kJson;
  const auto period = json ? Clock::duration(kJsonPeriod)
                           : (terminal_ ? Clock::duration(kLivePeriod) : kPlainPeriod);
  // A program that reads hears at once that the batch has begun.
  const bool first = json && !begun_;
  if (!first && Clock::now() - last_ < period) return;
  begun_ = true;
  last_ = Clock::now();
  if (json) {
    const std::string line = JsonOf(reading).dump(-1, ' ', false, Json::error_handler_t::replace);
    fmt::print(stderr, "{}\n", line);
  } else if (terminal_) {
    ShowLive(reading);
  } else {
    fmt::print(stderr, "folprom: {}\n", TextOf(reading));
  }
  std::fflush(stderr);
}

void BatchDisplay::ShowLive(const BatchReading& reading) {
  const std::string_view colour = cli::ColourWanted() ? "\033[36m" : "";
  const std::string_view plain = cli::ColourWanted() ? "\033[0m" : "";
  Clear();
  fmt::print(stderr, "{}{}\n{}{}", colour, Fitting(TextOf(reading)), Fitting(RunningText(reading)),
             plain);
  shown_ = true;
}

void BatchDisplay::Clear() {
  // Both lines, from the second one.
  if (shown_) fmt::print(stderr, "\r\033[K\033[A\r\033[K");
  shown_ = false;
}

std::string TextOf(const BatchReading& reading) {
  std::string text = fmt::format("{} of {} scans", reading.scans_done, reading.scans);
  if (reading.scans_failed > 0) text += fmt::format("  {} failed", reading.scans_failed);
  text += fmt::format("  {:.0f} %", 100 * reading.fraction);
  if (reading.vertices_per_second > 0) {
    text += "  " + cli::RateText(reading.vertices_per_second) + " vertices/s";
  }
  if (reading.seconds_left > 0) text += "  " + cli::TimeText(reading.seconds_left) + " left";
  return text + "  " + cli::BytesShort(reading.memory_bytes);
}

std::string RunningText(const BatchReading& reading) {
  if (reading.running.empty()) return "";
  const BatchReading::Running& first = reading.running.front();
  std::string text = fmt::format("{} {}: {}", NameOf(first.operation), first.scan,
                                 cli::ProgressText(first.progress));
  if (reading.running.size() > 1) text += fmt::format("  and {} more", reading.running.size() - 1);
  return text;
}

Json JsonOf(const BatchReading& reading) {
  Json running = Json::array();
  for (const BatchReading::Running& one : reading.running) {
    Json json = {{"job", one.job}, {"scan", one.scan}, {"operation", NameOf(one.operation)}};
    json.update(cli::ProgressJson(one.progress));
    running.push_back(json);
  }
  return {{"scans", reading.scans},
          {"scans_done", reading.scans_done},
          {"scans_failed", reading.scans_failed},
          {"fraction", reading.fraction},
          {"vertices_per_second", reading.vertices_per_second},
          {"seconds_left", reading.seconds_left > 0 ? Json(reading.seconds_left) : Json(nullptr)},
          {"seconds", reading.seconds},
          {"memory_bytes", reading.memory_bytes},
          {"running", running}};
}

}  // namespace folprom::batch
