#include "apps/folprom/session.h"

#include <signal.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>

#include "io/files/cut_pages.h"

namespace folprom::cli {
namespace {

std::atomic<parallel::Progress*> active_progress{nullptr};
static_assert(std::atomic<parallel::Progress*>::is_always_lock_free);

void CancelActive(int) {
  if (parallel::Progress* progress = active_progress.load()) progress->Cancel();
}

void SetUpLog(const CommonFlags& flags) {
  const auto mode = ColourWanted() ? spdlog::color_mode::always : spdlog::color_mode::never;
  auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>(mode);
  auto logger = std::make_shared<spdlog::logger>("folprom", std::move(sink));
  logger->set_pattern("folprom: %^%l%$: %v");
  logger->set_level(flags.verbose ? spdlog::level::debug : spdlog::level::warn);
  spdlog::set_default_logger(std::move(logger));
}

void HandleSignals() {
  struct sigaction action = {};
  action.sa_handler = CancelActive;
  // Once: whoever asks a second time means at once.
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction before = {};
  sigaction(SIGHUP, nullptr, &before);
  // Under nohup the program lives on.
  if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
  // A file that may not grow is an output error like a full disk, not the end of the program.
  struct sigaction ignore = {};
  ignore.sa_handler = SIG_IGN;
  sigaction(SIGXFSZ, &ignore, nullptr);
  io::ReadCutPagesAsZeros();
}

}  // namespace

Session::Session(const CommonFlags& flags) {
  SetUpLog(flags);
  active_progress = &progress_;
  HandleSignals();
  if (flags.progress_json || (!flags.quiet && !flags.json)) {
    display_ = std::make_unique<ProgressDisplay>(progress_, flags.verbose, flags.progress_json);
  }
}

Session::~Session() { active_progress = nullptr; }

double Session::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

void CancelOnSignals(parallel::Progress* progress) {
  active_progress = progress;
  HandleSignals();
  // The death of the parent may be told more than once.
  struct sigaction action = {};
  action.sa_handler = CancelActive;
  action.sa_flags = SA_RESTART;
  sigaction(SIGTERM, &action, nullptr);
}

uint64_t ResidentBytes(pid_t process) {
  unsigned long long pages_in_all = 0, resident_pages = 0;
  std::FILE* file = std::fopen(
      ("/proc/" + (process == 0 ? "self" : std::to_string(process)) + "/statm").c_str(), "r");
  if (file == nullptr) return 0;
  const int read = std::fscanf(file, "%llu %llu", &pages_in_all, &resident_pages);
  std::fclose(file);
  return read == 2 ? resident_pages * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

uint64_t PeakResidentBytes() {
  struct rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

void LogWarnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) spdlog::warn("{}", warning);
}

}  // namespace folprom::cli
