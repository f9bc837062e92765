#include "tests/hostile/program_run.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <stdexcept>

#include "tests/hostile/support.h"
#include "tests/support/child_process.h"

namespace folprom::hostile {
namespace {

constexpr unsigned kLongestSeconds = 60;  // an alarm outlives execv

std::string TakeText(const std::string& path) {
  const Bytes bytes = FileContent(path);
  std::remove(path.c_str());
  return {bytes.begin(), bytes.end()};
}

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

}  // namespace

ProgramRun RunProgram(const std::vector<std::string>& arguments, const std::string& folder) {
  const std::string out = folder + "/program.out", err = folder + "/program.err";
  const pid_t process =
      support::StartProgram(FOLPROM_PROGRAM, arguments, out, err, [] { alarm(kLongestSeconds); });
  if (process < 0) throw std::runtime_error("no child process");
  int status = 0;
  rusage usage{};
  if (wait4(process, &status, 0, &usage) != process) throw std::runtime_error("child lost");
  ProgramRun run;
  if (WIFEXITED(status)) run.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) run.signal = WTERMSIG(status);
  run.cpu_seconds = Seconds(usage.ru_utime) + Seconds(usage.ru_stime);
  run.peak_bytes = static_cast<uint64_t>(usage.ru_maxrss) * 1024;
  run.out = TakeText(out);
  run.err = TakeText(err);
  return run;
}

}  // namespace folprom::hostile
