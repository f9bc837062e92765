// Inputs that somebody writes or cuts while they are read.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "io/files/cut_pages.h"
#include "parallel/progress.h"
#include "parallel/runner.h"
#include "tests/hostile/guarded_child.h"
#include "tests/hostile/small_scans.h"
#include "tests/hostile/support.h"

namespace folprom::hostile {
namespace fs = std::filesystem;
namespace {

/// Serial; does something before it begins its n-th loop.
class MeddlingRunner final : public parallel::Runner {
 public:
  MeddlingRunner(size_t loop, std::function<void()> meddle)
      : loop_(loop), meddle_(std::move(meddle)) {}
  int threads() const override { return 1; }
  void ForEach(size_t count, const std::function<void(size_t)>& task) override {
    Count();
    serial_->ForEach(count, task);
  }
  void Ordered(size_t count, size_t window, const std::function<void(size_t)>& produce,
               const std::function<void(size_t)>& consume) override {
    Count();
    serial_->Ordered(count, window, produce, consume);
  }
  size_t loops() const { return loops_; }

 private:
  void Count() {
    if (loops_++ == loop_) meddle_();
  }
  std::unique_ptr<parallel::Runner> serial_ = parallel::MakeSerialRunner();
  size_t loop_, loops_ = 0;
  std::function<void()> meddle_;
};

/// What is done to the input.
enum class Harm { kCut, kWritten, kReplaced };

void Do(Harm harm, const std::string& path) {
  if (harm == Harm::kCut) return fs::resize_file(path, 100);
  if (harm == Harm::kReplaced) {
    WriteFile(path + ".new", std::string_view("another file"));
    return fs::rename(path + ".new", path);
  }
  // All of it but the first bytes, and later than it was.
  Bytes bytes = FileContent(path);
  for (size_t i = 200; i < bytes.size(); ++i) bytes[i] = static_cast<uint8_t>(bytes[i] ^ i);
  std::fstream(path, std::ios::in | std::ios::out | std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  fs::last_write_time(path, fs::last_write_time(path) + std::chrono::seconds(2));
}

constexpr size_t kLoops = 12;

class ChangedInput : public ::testing::Test {
 protected:
  ChangedInput() {
    io::ReadCutPagesAsZeros();
    WriteFile(folder_.File("out"), std::string_view("old"));
  }
  /// Runs work(path, runner) with the input harmed before each of its loops. Its error is kInput
  /// and says so, or none where nothing was harmed any more, or the input only replaced.
  void Expect(const std::string& name, const Bytes& input,
              const std::function<Error(const std::string&, parallel::Runner&)>& work) {
    const std::string path = folder_.File(name);
    const std::string faults = RunGuarded(3 * kLoops, 60, 0, [&](size_t i) {
      const auto harm = static_cast<Harm>(i % 3);
      fs::remove(path);
      WriteFile(path, input);
      bool is_harmed = false;
      MeddlingRunner runner(i / 3, [&] {
        is_harmed = true;
        Do(harm, path);
      });
      const Error error = work(path, runner);
      const bool expected = is_harmed && harm != Harm::kReplaced;
      const bool is_told = error.kind == ErrorKind::kInput &&
                           error.message.find("changed while it was read") != std::string::npos;
      const bool fits = expected ? is_told : error.message.empty();
      if (!fits) std::fprintf(stderr, "case %zu: %s\n", i, error.message.c_str());
      return fits && (!expected || FileContent(folder_.File("out.ply")).empty());
    });
    EXPECT_EQ(faults, "") << name;
    fs::remove(path);
  }
  template <class Report>
  static Error ErrorOf(const Result<Report>& report) {
    return report.ok() ? Error{ErrorKind::kUsage, ""} : report.error();
  }

  TemporaryFolder folder_;
  parallel::Progress progress_;
};

TEST_F(ChangedInput, OfEncodeIsToldAndLeavesTheOutput) {
  const std::string ply = PlyBytes(WavySheet(50), PlyForm::kBigEndian);
  const std::string ascii = PlyBytes(WavySheet(30), PlyForm::kAscii);
  for (const auto& [name, text] : {std::pair{"a.ply", ply}, {"b.ply", ascii}}) {
    Expect(name, Bytes(text.begin(), text.end()), [&](const std::string& path, auto& runner) {
      EncodeOptions options = SmallOptions(400);
      options.temporary_folder = folder_.path();
      fs::remove(folder_.File("out.ply"));
      return ErrorOf(EncodeFile(path, folder_.File("out.ply"), options, runner, progress_));
    });
  }
}

TEST_F(ChangedInput, OfDecodeIsToldAndLeavesTheOutput) {
  Expect("a.folp", Encoded(WavySheet(30), SmallOptions(300)),
         [&](const std::string& path, auto& runner) {
           DecodeOptions options;
           options.temporary_folder = folder_.path();
           fs::remove(folder_.File("out.ply"));
           return ErrorOf(DecodeFile(path, folder_.File("out.ply"), options, runner, progress_));
         });
}

}  // namespace
}  // namespace folprom::hostile
