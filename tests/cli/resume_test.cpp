// An encoding that is interrupted or killed at any moment, and the same command again.
#include <signal.h>

#include <chrono>
#include <random>
#include <thread>

#include "tests/cli/program.h"

namespace folprom::cli_test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

class Resume : public CliTest {
 protected:
  void SetUp() override {
    fs::create_directory(Path("tmp"));
    ASSERT_EQ(Run({"synth", "--vertices", "6k", "-o", Path("scan.ply"), "-q"}).exit_code, 0);
    const auto begin = Clock::now();
    ASSERT_EQ(Run(Command("whole.folp")).exit_code, 0);
    whole_run_ = Clock::now() - begin;
    whole_ = FileText(Path("whole.folp"));
  }

  std::vector<std::string> Command(const std::string& output) const {
    // -f: a kill may come between the renaming of the output and the end of the program.
    return {"encode", Path("scan.ply"), "-o",        Path(output), "-f", "--subtree-vertices",
            "200",    "--tmp",          Path("tmp"), "--json"};
  }

  // Nothing but the spill, and what was there before.
  void ExpectNothingElse(bool has_output) const {
    std::vector<std::string> expected = {"scan.ply", "tmp", "whole.folp"};
    if (has_output) expected.insert(expected.begin(), "cut.folp");
    EXPECT_EQ(Files(), expected);
  }

  // Ends encodings by the signal at ten moments, spread over the time that one takes.
  void EndAndGoOn(int signal, unsigned seed) {
    constexpr int kMoments = 10;
    std::mt19937 random(seed);
    int ended = 0;
    for (int i = 0; i < kMoments; ++i) {
      const double part = (i + static_cast<double>(random() % 1000) / 1000) / kMoments;
      const pid_t process = Start(Command("cut.folp"));
      std::this_thread::sleep_for(whole_run_ * part);
      kill(process, signal);
      const int code = Wait(process).exit_code;
      // Before its handler stands an interrupt ends the program itself; a fast run is done before.
      EXPECT_TRUE(code == 130 || code == 0 || code == -1) << code;
      const bool has_output = fs::exists(Path("cut.folp"));
      ExpectNothingElse(has_output);
      if (has_output) {
        EXPECT_EQ(FileText(Path("cut.folp")), whole_);
      }
      EXPECT_TRUE(has_output || code != 0);
      ended += code != 0;
      const Outcome outcome = Run(Command("cut.folp"));
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
      EXPECT_EQ(FileText(Path("cut.folp")), whole_) << part;
      resumed_ += outcome.json().at("resumed_subtrees").get<int>();
      ExpectNothingElse(true);
      EXPECT_TRUE(fs::is_empty(Path("tmp")));
      fs::remove(Path("cut.folp"));
    }
    EXPECT_GT(ended, 0);
  }

  std::chrono::duration<double> whole_run_{0};
  std::string whole_;
  int resumed_ = 0;
};

TEST_F(Resume, KilledAtAnyMomentEndsWithTheSameBytes) {
  EndAndGoOn(SIGKILL, 1);
  EXPECT_GT(resumed_, 0);
}

TEST_F(Resume, InterruptedAtAnyMomentEndsWithTheSameBytes) {
  EndAndGoOn(SIGINT, 2);
  EXPECT_GT(resumed_, 0);
}

// Each time a little further, as on a machine that fails again and again.
TEST_F(Resume, KilledAgainAndAgainComesToAnEnd) {
  int runs = 0, code = -1;
  for (; code != 0 && runs < 40; ++runs) {
    const pid_t process = Start(Command("cut.folp"));
    std::this_thread::sleep_for(whole_run_ * (0.4 + 0.05 * runs));
    kill(process, SIGKILL);
    code = Wait(process).exit_code;
  }
  ASSERT_EQ(code, 0);
  EXPECT_GT(runs, 1);
  EXPECT_EQ(FileText(Path("cut.folp")), whole_);
  EXPECT_TRUE(fs::is_empty(Path("tmp")));
}

TEST_F(Resume, SaysWhereItGoesOnAndWhy) {
  const pid_t process = Start(Command("cut.folp"));
  while (fs::is_empty(Path("tmp")) ||
         !fs::exists(fs::directory_iterator(Path("tmp"))->path() / "journal")) {
    std::this_thread::yield();
  }
  kill(process, SIGINT);
  const Outcome cut = Wait(process);
  if (cut.exit_code == 0) GTEST_SKIP() << "it was done before the signal came";
  EXPECT_EQ(cut.exit_code, 130);
  EXPECT_NE(cut.err.find("the same command goes on"), std::string::npos) << cut.err;
  auto other = Command("cut.folp");
  other.insert(other.end(), {"--bits", "10"});
  const Outcome outcome = Run(other);
  ASSERT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("the settings have changed"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.json().at("resumed_subtrees"), 0);
}

TEST_F(Resume, RestartBeginsAnew) {
  const pid_t process = Start(Command("cut.folp"));
  std::this_thread::sleep_for(whole_run_ / 2);
  kill(process, SIGKILL);
  Wait(process);
  fs::remove(Path("cut.folp"));
  auto command = Command("cut.folp");
  command.push_back("--restart");
  const Outcome outcome = Run(command);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.json().at("resumed_subtrees"), 0);
  EXPECT_EQ(FileText(Path("cut.folp")), whole_);
  EXPECT_TRUE(fs::is_empty(Path("tmp")));
}

}  // namespace
}  // namespace folprom::cli_test
