// Runs a whole program and measures it.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace folprom::peers {

struct Run {
  bool succeeded = false;
  double seconds = 0;       ///< wall clock, from before the start to after the end
  uint64_t peak_bytes = 0;  ///< largest resident size
};

/// From now on a signal to stop ends the running program too, and what runs it throws Failure
/// kInterrupted, so that temporary files go.
void StopOnSignals();

/// A program found on PATH, with its arguments.
using Command = std::vector<std::string>;

/// Standard output goes to the file `output`, standard error to `log`; empty: nowhere. Throws
/// Failure where no process can be made. The peak counts what this process has resident at the
/// start of the child: keep it small.
Run Execute(const Command& command, const std::string& output, const std::string& log);

/// What a program of ours prints; `scratch` is a file for it. Standard error stays the caller's.
/// Throws Failure, naming the program, where it fails or prints something else.
nlohmann::json JsonOf(const Command& command, const std::string& scratch);

/// Is there such a program on PATH.
bool OnPath(const std::string& program);

}  // namespace folprom::peers
