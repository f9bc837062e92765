#include "tests/cli/program.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <fstream>
#include <sstream>

#include "tests/support/child_process.h"

namespace folprom::cli_test {
namespace fs = std::filesystem;

std::string FileText(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

void WriteText(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

CliTest::CliTest() : folder_(root_.File("files")) { fs::create_directory(folder_); }

pid_t CliTest::Start(const std::vector<std::string>& arguments, uint64_t largest_file) const {
  WriteText(root_.File("err"), "");
  const auto prepare = [largest_file] {
    // Under nohup it is ignored, which a program inherits.
    signal(SIGHUP, SIG_DFL);
    if (largest_file == 0) return;
    const rlimit limit{largest_file, largest_file};
    setrlimit(RLIMIT_FSIZE, &limit);
  };
  return support::StartProgram(FOLPROM_PROGRAM, arguments, root_.File("out"), root_.File("err"),
                               prepare);
}

std::string CliTest::ErrorsSoFar() const { return FileText(root_.File("err")); }

Outcome CliTest::Wait(pid_t process) const {
  int status = 0;
  waitpid(process, &status, 0);
  Outcome outcome;
  if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
  outcome.out = FileText(root_.File("out"));
  outcome.err = FileText(root_.File("err"));
  return outcome;
}

void CliTest::ExpectError(const std::vector<std::string>& arguments, int exit_code,
                          const std::string& part) const {
  const Outcome outcome = Run(arguments);
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(outcome.err.starts_with("folprom: ")) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
}

}  // namespace folprom::cli_test
