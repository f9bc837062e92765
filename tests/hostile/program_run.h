// Runs the built program, and tells what it took.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace folprom::hostile {

struct ProgramRun {
  int exit_code = -1;       ///< -1: ended by a signal
  int signal = 0;           ///< that one, SIGALRM after a minute
  double cpu_seconds = 0;   ///< of all its threads
  uint64_t peak_bytes = 0;  ///< resident; not less than what this process itself has
  std::string out, err;
};

/// Standard output and error go to files in `folder` meanwhile.
ProgramRun RunProgram(const std::vector<std::string>& arguments, const std::string& folder);

}  // namespace folprom::hostile
