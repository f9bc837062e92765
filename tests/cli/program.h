// Runs the built program as a user would: arguments in; exit code, output and files out.
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace folprom::cli_test {

struct Outcome {
  int exit_code = -1;  ///< -1: ended by a signal
  std::string out;
  std::string err;

  nlohmann::json json() const { return nlohmann::json::parse(out); }
};

std::string FileText(const std::filesystem::path& path);
void WriteText(const std::filesystem::path& path, const std::string& text);

/// A folder of its own for each test, removed afterwards.
class CliTest : public ::testing::Test {
 protected:
  CliTest();

  std::string Path(const std::string& name) const { return (folder_ / name).string(); }
  /// Names of all files in the folder, hidden ones too, sorted.
  std::vector<std::string> Files() const { return support::NamesIn(folder_); }

  /// Starts the program; standard output and error go to files outside the folder.
  /// largest_file: bytes to which it may write a file, 0 for any number.
  pid_t Start(const std::vector<std::string>& arguments, uint64_t largest_file = 0) const;
  /// Standard error of the program so far.
  std::string ErrorsSoFar() const;
  Outcome Wait(pid_t process) const;
  Outcome Run(const std::vector<std::string>& arguments) const { return Wait(Start(arguments)); }

  /// Expects this exit code, nothing on standard output, and one line "folprom: ..." that has
  /// `part` in it.
  void ExpectError(const std::vector<std::string>& arguments, int exit_code,
                   const std::string& part) const;

 private:
  support::TemporaryFolder root_;
  std::filesystem::path folder_;
};

}  // namespace folprom::cli_test
