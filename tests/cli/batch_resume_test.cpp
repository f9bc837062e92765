// A batch that is interrupted or killed, and started again.
#include <signal.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <sstream>
#include <thread>

#include "tests/cli/batch_fixture.h"

namespace folprom::cli_test {
namespace {

class BatchResume : public BatchTest {
 protected:
  static constexpr int kScans = 3;

  void SetUp() override {
    for (int i = 0; i < kScans; ++i) MakeScan("scans/s" + std::to_string(i) + ".ply", 1000, i);
    std::filesystem::create_directory(Path("tmp"));
    WriteJob(JobFor("whole"));
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(RunBatch().exit_code, 0);
    whole_run_ = std::chrono::duration_cast<std::chrono::milliseconds>(
        std::chrono::steady_clock::now() - begin);
    WriteJob(JobFor("cut"));
  }

  // Before half of an uninterrupted run is over.
  template <class Random>
  std::chrono::milliseconds Moment(Random& random) const {
    return whole_run_ * static_cast<int>(random() % 50) / 100;
  }

  std::string JobFor(const std::string& output) const {
    return "[defaults]\ntmp = \"tmp\"\n[[job]]\ninput = \"scans/*\"\noutput = \"" + output +
           "\"\noperations = [\"encode\", \"verify\", \"decode\"]\nlods = [{ bpv = 4 }, {}]\n";
  }

  // Operations that the state file says are done.
  std::vector<std::string> Done() const {
    std::vector<std::string> done;
    std::istringstream lines(FileText(Path("cut/.folprom-batch")));
    for (std::string line; std::getline(lines, line);) {
      const auto json = nlohmann::json::parse(line, nullptr, false);
      if (json.is_object() && json.contains("done")) done.push_back(json.at("done"));
    }
    return done;
  }

  // Whole outputs only, each as an uninterrupted run makes it.
  void ExpectPartOfTheWhole() const {
    if (!std::filesystem::exists(Path("cut"))) return;
    const auto whole = Contents("whole");
    for (const auto& [name, content] : Contents("cut")) {
      ASSERT_TRUE(whole.contains(name)) << name;
      EXPECT_EQ(content, whole.at(name)) << name;
    }
  }

  // What encodings go on from, and no other temporary files.
  void ExpectOnlySpills() const {
    for (const auto& entry : std::filesystem::directory_iterator(Path("tmp"))) {
      EXPECT_TRUE(entry.path().filename().string().starts_with("folprom-encode-")) << entry.path();
    }
  }

  // Starts the batch, ends it by the signal after a moment, and gives its exit code.
  int RunAndSignal(int signal, std::chrono::milliseconds moment) const {
    const pid_t process = Start({"batch", Path("job.toml"), "--no-pictures"});
    std::this_thread::sleep_for(moment);
    kill(process, signal);
    return Wait(process).exit_code;
  }

  void ExpectNoFinishedOperationRuns(const std::vector<std::string>& done) const {
    const nlohmann::json report = Report();
    for (const auto& result : report.at("results")) {
      const auto output =
          result.at("operation") == "verify" ? result.at("folp") : result.at("output");
      const std::string key = result.at("operation").get<std::string>() + " " +
                              std::filesystem::path(output.get<std::string>()).filename().string();
      if (std::find(done.begin(), done.end(), key) == done.end()) continue;
      EXPECT_EQ(result.at("status"), "up_to_date") << key;
    }
  }

  std::chrono::milliseconds whole_run_{0};
};

TEST_F(BatchResume, InterruptedAtAnyMomentEndsWithTheSameOutputs) {
  std::mt19937 random(7);
  for (int round = 0; round < 3; ++round) {
    std::filesystem::remove_all(Path("cut"));
    int interrupted = 0;
    for (int i = 0; i < 3; ++i) {
      const int code = RunAndSignal(SIGINT, Moment(random));
      // Before the handler stands the signal itself ends it; a fast run is done before it comes.
      EXPECT_TRUE(code == 130 || code == 0 || code == -1) << code;
      interrupted += code == 130;
      ExpectPartOfTheWhole();
      ExpectOnlySpills();
      if (code != 130) continue;
      EXPECT_EQ(Report().at("interrupted"), true);
      EXPECT_EQ(Report().at("exit_code"), 130);
    }
    EXPECT_GT(interrupted, 0);
    const std::vector<std::string> done = Done();
    ASSERT_EQ(RunBatch().exit_code, 0);
    EXPECT_EQ(Contents("cut"), Contents("whole"));
    EXPECT_TRUE(std::filesystem::is_empty(Path("tmp")));
    ExpectNoFinishedOperationRuns(done);
  }
}

TEST_F(BatchResume, KilledAtAnyMomentEndsWithTheSameOutputs) {
  std::mt19937 random(8);
  for (int round = 0; round < 3; ++round) {
    std::filesystem::remove_all(Path("cut"));
    int killed = 0;
    for (int i = 0; i < 3; ++i) {
      const int code = RunAndSignal(SIGKILL, Moment(random));
      // Later runs have less to do, and may be done before.
      EXPECT_TRUE(code == 0 || code == -1) << code;
      killed += code == -1;
    }
    EXPECT_GT(killed, 0);
    // The next run waits for what the killed one left running.
    const Outcome outcome = RunBatch();
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(Contents("cut"), Contents("whole"));
    ASSERT_EQ(RunBatch().exit_code, 0);
    for (const auto& [name, status] : Statuses()) EXPECT_EQ(status, "up_to_date") << name;
    EXPECT_TRUE(std::filesystem::is_empty(Path("tmp")));
  }
}

TEST_F(BatchResume, CutStateFileLosesNoMoreThanItsLastLine) {
  WriteJob(JobFor("whole"));
  const std::string state = FileText(Path("whole/.folprom-batch"));
  for (size_t part = 1; part < 5; ++part) {
    WriteText(Path("whole/.folprom-batch"), state.substr(0, state.size() - part * 100));
    ASSERT_EQ(RunBatch().exit_code, 0) << part;
    size_t run = 0;
    for (const auto& [name, status] : Statuses()) run += status == "done";
    EXPECT_LE(run, 2) << part;
    WriteText(Path("whole/.folprom-batch"), state);
  }
}

TEST_F(BatchResume, StateFileOfRubbishIsNoState) {
  const auto whole = Contents("whole");
  WriteJob(JobFor("whole") + "existing = \"overwrite\"\n");
  for (const std::string rubbish :
       {"\n\n{}\n[]\n{\"done\":3}\n", "{\"done\":\"encode s0.folp\",\"record\":{}}\n",
        "{\"begin\":\"encode s0.folp\"}\n{\"begin\":\"x\",\"process\":-1}\n", "\xff\xfe\n"}) {
    WriteText(Path("whole/.folprom-batch"), rubbish);
    ASSERT_EQ(RunBatch().exit_code, 0) << rubbish;
    EXPECT_EQ(Contents("whole"), whole);
  }
}

TEST_F(BatchResume, TwoBatchesInOneFolderWaitForEachOther) {
  const pid_t first = Start({"batch", Path("job.toml"), "--no-pictures"});
  const pid_t second = fork();
  if (second == 0) {
    execl(FOLPROM_PROGRAM, FOLPROM_PROGRAM, "batch", Path("job.toml").c_str(), "-q",
          "--no-pictures", nullptr);
    _exit(127);
  }
  EXPECT_EQ(Wait(first).exit_code, 0);
  int status = 0;
  waitpid(second, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(Contents("cut"), Contents("whole"));
}

}  // namespace
}  // namespace folprom::cli_test
