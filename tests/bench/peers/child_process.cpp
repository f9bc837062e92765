#include "tests/bench/peers/child_process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "folprom/result.h"

namespace folprom::peers {
namespace {

volatile std::sig_atomic_t stopped = 0;

/// Where a standard stream of the child goes: a file, or unchanged.
using Target = std::optional<std::string>;

void Redirect(const Target& target, int stream) {
  if (!target) return;
  const char* path = target->empty() ? "/dev/null" : target->c_str();
  const int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file < 0 || dup2(file, stream) < 0) _exit(126);
  close(file);
}

Run Start(const Command& command, const Target& output, const Target& log) {
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  const auto begin = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child < 0) throw Failure(ErrorKind::kLimit, std::string("fork: ") + std::strerror(errno));
  if (child == 0) {
    Redirect(output, STDOUT_FILENO);
    Redirect(log, STDERR_FILENO);
    execvp(words.front(), words.data());
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  while (wait4(child, &status, 0, &usage) < 0) {
    if (errno != EINTR) {
      throw Failure(ErrorKind::kInternal, std::string("wait4: ") + std::strerror(errno));
    }
    if (stopped != 0) kill(child, SIGTERM);
  }
  if (stopped != 0) throw Failure(ErrorKind::kInterrupted, "interrupted");
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  return {WIFEXITED(status) && WEXITSTATUS(status) == 0, seconds.count(),
          static_cast<uint64_t>(usage.ru_maxrss) * 1024};
}

}  // namespace

void StopOnSignals() {
  struct sigaction action {};
  action.sa_handler = [](int) { stopped = 1; };
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}

Run Execute(const Command& command, const std::string& output, const std::string& log) {
  return Start(command, output, log);
}

nlohmann::json JsonOf(const Command& command, const std::string& scratch) {
  if (!Start(command, scratch, std::nullopt).succeeded) {
    throw Failure(ErrorKind::kInternal, command.front() + " failed");
  }
  std::ifstream file(scratch);
  nlohmann::json json = nlohmann::json::parse(file, nullptr, false);
  if (json.is_discarded()) {
    throw Failure(ErrorKind::kInternal, command.front() + " did not print JSON");
  }
  return json;
}

bool OnPath(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
  }
  return false;
}

}  // namespace folprom::peers
