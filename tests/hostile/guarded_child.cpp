#include "tests/hostile/guarded_child.h"

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <exception>
#include <new>
#include <stdexcept>

namespace folprom::hostile {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
const bool kMeasuresMemory = false;
#else
const bool kMeasuresMemory = true;
#endif

namespace {

constexpr int kBroken = 41, kThrown = 42, kFlooded = 43;

/// What the child tells the parent, in shared memory.
struct Shared {
  std::atomic<size_t> next{0};  ///< case under way
  std::atomic<uint64_t> growth{0};
};

uint64_t PeakBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

[[noreturn]] void RunCases(Shared* shared, size_t cases, unsigned cpu_seconds,
                           uint64_t growth_bytes, const std::function<bool(size_t)>& work) {
  const uint64_t before = PeakBytes();
  signal(SIGPROF, SIG_DFL);
  for (size_t i = shared->next; i < cases; shared->next = ++i) {
    const itimerval timer{{0, 0}, {static_cast<time_t>(cpu_seconds), 0}};
    setitimer(ITIMER_PROF, &timer, nullptr);
    int code = 0;
    try {
      if (!work(i)) code = kBroken;
    } catch (const std::exception&) {
      code = kThrown;
    }
    shared->growth = PeakBytes() - before;
    if (kMeasuresMemory && growth_bytes > 0 && shared->growth > growth_bytes) code = kFlooded;
    if (code != 0) _exit(code);
  }
  _exit(0);
}

std::string Verdict(int status, unsigned cpu_seconds, uint64_t growth) {
  if (WIFSIGNALED(status)) {
    if (WTERMSIG(status) == SIGPROF) {
      return "still running after " + std::to_string(cpu_seconds) + " s";
    }
    return "killed by signal " + std::to_string(WTERMSIG(status));
  }
  switch (WEXITSTATUS(status)) {
    case kBroken:
      return "breaks its promise";
    case kThrown:
      return "throws";
    case kFlooded:
      return "memory grows by " + std::to_string(growth >> 10) + " KiB";
    default:
      return "ends with status " + std::to_string(WEXITSTATUS(status));
  }
}

}  // namespace

std::string RunGuarded(size_t cases, unsigned cpu_seconds, uint64_t growth_bytes,
                       const std::function<bool(size_t)>& work) {
  void* memory =
      mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::runtime_error("no shared memory");
  auto* shared = new (memory) Shared;
  std::string faults;
  while (shared->next < cases) {
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("no child process");
    if (child == 0) RunCases(shared, cases, cpu_seconds, growth_bytes, work);
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) break;
    faults += "case " + std::to_string(shared->next) + " " +
              Verdict(status, cpu_seconds, shared->growth) + "\n";
    ++shared->next;
  }
  munmap(memory, sizeof(Shared));
  return faults;
}

}  // namespace folprom::hostile
