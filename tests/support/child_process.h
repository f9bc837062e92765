// Starts a program as a child process.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <string>
#include <vector>

namespace folprom::support {

/// Standard output and error go to the files `out` and `err`. prepare() is called in the child
/// before the program, whose exit code is 127 where it cannot be run. -1 where there is no child.
template <class Prepare>
pid_t StartProgram(const std::string& program, const std::vector<std::string>& arguments,
                   const std::string& out, const std::string& err, Prepare prepare) {
  std::vector<std::string> words = {program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t process = fork();
  if (process != 0) return process;
  dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
  dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
  prepare();
  execv(argv[0], argv.data());
  _exit(127);
}

}  // namespace folprom::support
