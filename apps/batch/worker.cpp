#include "apps/batch/worker.h"

#include <fcntl.h>
#include <signal.h>
#include <spdlog/fmt/fmt.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>

#include "apps/folprom/session.h"

namespace folprom::batch {
namespace {

// The stages that it names are text of the program, at the same place in parent and child.
parallel::Progress* SharedProgress() {
  void* memory = ::mmap(nullptr, sizeof(parallel::Progress), PROT_READ | PROT_WRITE,
                        MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) {
    io::ThrowSystemError(ErrorKind::kLimit, "batch", "cannot share memory with a process");
  }
  return new (memory) parallel::Progress();
}

std::string MessageOf(const Outcome& outcome) {
  Json json = {{"result", ToJson(outcome.result)}, {"record", nullptr}};
  if (outcome.record) json["record"] = ToJson(*outcome.record);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// None where the message was cut.
std::optional<Outcome> OutcomeOf(const std::string& message) {
  const Json json = Json::parse(message, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  Outcome outcome{OperationFromJson(json.at("result")).value(), std::nullopt};
  if (!json.at("record").is_null()) outcome.record = RecordFromJson(json.at("record")).value();
  return outcome;
}

Error DeathOf(int status) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) {
    return {ErrorKind::kLimit,
            "its process was killed, perhaps for want of memory; a smaller -M may help"};
  }
  if (WIFSIGNALED(status) && WTERMSIG(status) != SIGINT && WTERMSIG(status) != SIGTERM) {
    return {ErrorKind::kInternal,
            fmt::format("its process ended by signal {} ({}); this is a bug, please report it",
                        WTERMSIG(status), ::strsignal(WTERMSIG(status)))};
  }
  if (WIFSIGNALED(status)) return {ErrorKind::kInterrupted, "interrupted"};
  return {ErrorKind::kInternal,
          fmt::format("its process ended with code {} and no result", WEXITSTATUS(status))};
}

}  // namespace

Worker::Worker(Plan* plan, size_t task, const Share& share)
    : task_(task), share_(share), progress_(SharedProgress()) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    io::ThrowSystemError(ErrorKind::kLimit, "batch", "cannot make a pipe");
  }
  pipe_ = io::Descriptor(ends[0]);
  const io::Descriptor child_end(ends[1]);
  ::fcntl(pipe_.get(), F_SETFL, O_NONBLOCK);
  // What is in a buffer would be written twice.
  std::fflush(nullptr);
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ < 0) io::ThrowSystemError(ErrorKind::kLimit, "batch", "cannot start a process");
  if (process_ == 0) RunChild(plan, child_end.get(), parent);
}

Worker::~Worker() {
  if (process_ > 0) {
    Cancel();
    int status = 0;
    ::waitpid(process_, &status, 0);
  }
}

void Worker::Unmap::operator()(parallel::Progress* progress) const {
  ::munmap(progress, sizeof(parallel::Progress));
}

void Worker::RunChild(Plan* plan, int descriptor, pid_t parent) {
  cli::CancelOnSignals(progress_.get());
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(1);
  int code = 1;
  try {
    const Outcome outcome = RunTask(plan, plan->tasks[task_], share_, *progress_);
    const std::string message = MessageOf(outcome);
    io::WriteAll(descriptor, {reinterpret_cast<const uint8_t*>(message.data()), message.size()},
                 "batch");
    code = 0;
  } catch (const std::exception&) {
    // The parent sees that there is no result.
  }
  ::_exit(code);
}

cli::ProgressReading Worker::Progress() {
  return clock_.Read(*progress_, cli::ResidentBytes(process_));
}

bool Worker::Receive() {
  std::array<char, 65536> piece;
  while (true) {
    const ssize_t size = ::read(pipe_.get(), piece.data(), piece.size());
    if (size > 0) {
      message_.append(piece.data(), static_cast<size_t>(size));
    } else if (size == 0) {
      return true;
    } else if (errno != EINTR) {
      return errno != EAGAIN;
    }
  }
}

Outcome Worker::Finish(const Plan& plan) {
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  if (auto outcome = OutcomeOf(message_)) return std::move(*outcome);
  const Error error = DeathOf(status);
  Outcome outcome{plan.ResultOf(plan.tasks[task_]), std::nullopt};
  outcome.result.status =
      error.kind == ErrorKind::kInterrupted ? Status::kInterrupted : Status::kFailed;
  outcome.result.exit_code = static_cast<int>(error.kind);
  outcome.result.error = error.message;
  return outcome;
}

}  // namespace folprom::batch
