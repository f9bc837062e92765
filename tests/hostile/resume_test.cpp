// An encoding goes on from what an interrupted one left, and never from what it should not trust.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <functional>
#include <memory>

#include "io/spill/spill.h"
#include "parallel/progress.h"
#include "parallel/runner.h"
#include "tests/hostile/support.h"

namespace folprom::hostile {
namespace {

namespace fs = std::filesystem;

/// Serial; cancels the job after a task of this stage once so much of it is done.
class CancellingRunner final : public parallel::Runner {
 public:
  CancellingRunner(parallel::Progress& progress, const char* stage, uint64_t done)
      : progress_(progress), stage_(stage), done_(done) {}
  int threads() const override { return 1; }
  void ForEach(size_t count, const std::function<void(size_t)>& task) override {
    serial_->ForEach(count, [&](size_t i) {
      task(i);
      if (std::strcmp(progress_.stage(), stage_) == 0 && progress_.done() >= done_) {
        progress_.Cancel();
      }
    });
  }
  void Ordered(size_t count, size_t window, const std::function<void(size_t)>& produce,
               const std::function<void(size_t)>& consume) override {
    serial_->Ordered(count, window, produce, consume);
  }

 private:
  parallel::Progress& progress_;
  const char* stage_;
  uint64_t done_;
  std::unique_ptr<parallel::Runner> serial_ = parallel::MakeSerialRunner();
};

class Resumed : public ::testing::Test {
 protected:
  Resumed() {
    fs::create_directory(folder_.File("tmp"));
    WriteScan(WavySheet(60));
    options_.temporary_folder = folder_.File("tmp");
    whole_ = EncodedBytes(Resume::kNever);
  }

  void WriteScan(const TestMesh& mesh) { WriteFile(folder_.File("scan.ply"), PlyBytes(mesh)); }

  Result<EncodeReport> Encode(parallel::Progress& progress, Resume resume) {
    const auto runner = parallel::MakeTbbRunner(2);
    return EncodeFile(folder_.File("scan.ply"), folder_.File("out.folp"), options_, *runner,
                      progress, resume);
  }

  /// Encodes to the end and takes the output away.
  Bytes EncodedBytes(Resume resume) {
    parallel::Progress progress;
    report_ = Encode(progress, resume).value();
    EXPECT_TRUE(fs::is_empty(folder_.File("tmp")));
    const Bytes bytes = FileContent(folder_.File("out.folp"));
    fs::remove(folder_.File("out.folp"));
    return bytes;
  }

  /// Cancels an encoding in this stage once so much of it is done.
  void Interrupt(const char* stage, uint64_t done) {
    parallel::Progress progress;
    CancellingRunner runner(progress, stage, done);
    const auto result = EncodeFile(folder_.File("scan.ply"), folder_.File("out.folp"), options_,
                                   runner, progress, Resume::kContinue);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().kind, ErrorKind::kInterrupted);
    EXPECT_NE(result.error().message.find(folder_.File("tmp")), std::string::npos);
    EXPECT_EQ(folder_.Names(), (std::vector<std::string>{"scan.ply", "tmp"}));
  }

  /// The kept folder as it was when `copy` was made of it.
  static void PutBack(const fs::path& copy, const fs::path& kept) {
    fs::create_directory(kept);
    fs::permissions(kept, fs::perms::owner_all);
    fs::copy(copy, kept, fs::copy_options::overwrite_existing | fs::copy_options::recursive);
  }

  /// The kept folder.
  fs::path Kept() const { return *fs::directory_iterator(folder_.File("tmp")); }

  void ExpectAnew(const char* reason) {
    EXPECT_EQ(report_.resumed_subtrees, 0U);
    ASSERT_FALSE(report_.warnings.empty());
    EXPECT_NE(report_.warnings.front().find(reason), std::string::npos) << report_.warnings.front();
  }

  TemporaryFolder folder_;
  EncodeOptions options_ = SmallOptions(200);
  Bytes whole_;
  EncodeReport report_;
};

TEST_F(Resumed, GoesOnWithTheSubtreesThatAreDone) {
  Interrupt("encode", 1500);
  EXPECT_EQ(EncodedBytes(Resume::kContinue), whole_);
  EXPECT_GE(report_.resumed_subtrees, 7U);
  EXPECT_LT(report_.resumed_subtrees, report_.subtrees);
  EXPECT_TRUE(report_.warnings.empty());
}

TEST_F(Resumed, GoesOnWithTheSeamsThatAreDone) {
  Interrupt("seams", 5);
  EXPECT_EQ(EncodedBytes(Resume::kContinue), whole_);
  EXPECT_EQ(report_.resumed_subtrees, report_.subtrees);
}

TEST_F(Resumed, GoesOnAfterEachOfManyInterruptions) {
  for (uint64_t done = 400; done < 3600; done += 400) Interrupt("encode", done);
  EXPECT_EQ(EncodedBytes(Resume::kContinue), whole_);
  EXPECT_GT(report_.resumed_subtrees, 0U);
}

TEST_F(Resumed, ExactCoordinatesGoOnToo) {
  options_.exact = true;
  whole_ = EncodedBytes(Resume::kNever);
  Interrupt("encode", 1500);
  EXPECT_EQ(EncodedBytes(Resume::kContinue), whole_);
  EXPECT_GT(report_.resumed_subtrees, 0U);
}

TEST_F(Resumed, AttributesGoOnToo) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3600\nproperty float x\nproperty float y\nproperty "
      "float z\nproperty uchar red\nproperty short weight\nelement face 3481\nproperty list uchar "
      "int vertex_indices\nend_header\n";
  for (int v = 0; v < 3600; ++v) {
    text += std::to_string(v % 60) + " " + std::to_string(v / 60) + " " +
            std::to_string(v * v % 7) + " " + std::to_string(v % 256) + " " +
            std::to_string(v * 31 % 999 - 500) + "\n";
  }
  for (int v = 0; v < 3540; ++v) {
    if (v % 60 == 59) continue;
    text += "3 " + std::to_string(v) + " " + std::to_string(v + 1) + " " + std::to_string(v + 60) +
            "\n";
  }
  WriteFile(folder_.File("scan.ply"), text);
  whole_ = EncodedBytes(Resume::kNever);
  ASSERT_EQ(report_.attributes.size(), 2U);
  Interrupt("encode", 1500);
  EXPECT_EQ(EncodedBytes(Resume::kContinue), whole_);
  EXPECT_GT(report_.resumed_subtrees, 0U);
}

TEST_F(Resumed, OtherThreadsAndMemoryGoOnToo) {
  Interrupt("encode", 1500);
  options_.limits.memory_bytes = uint64_t{256} << 20;
  EXPECT_EQ(EncodedBytes(Resume::kContinue), whole_);
  EXPECT_GT(report_.resumed_subtrees, 0U);
}

TEST_F(Resumed, RestartUsesNothing) {
  Interrupt("encode", 1500);
  EXPECT_EQ(EncodedBytes(Resume::kRestart), whole_);
  EXPECT_EQ(report_.resumed_subtrees, 0U);
  EXPECT_TRUE(report_.warnings.empty());
}

TEST_F(Resumed, OtherSettingsBeginAnew) {
  Interrupt("encode", 1500);
  options_.bits += 1;
  const Bytes expected = [&] {
    parallel::Progress progress;
    Encode(progress, Resume::kNever).value();
    const Bytes bytes = FileContent(folder_.File("out.folp"));
    fs::remove(folder_.File("out.folp"));
    return bytes;
  }();
  EXPECT_EQ(EncodedBytes(Resume::kContinue), expected);
  ExpectAnew("the settings have changed");
}

TEST_F(Resumed, AnotherScanBeginsAnew) {
  Interrupt("encode", 1500);
  TestMesh other = WavySheet(60);
  other.positions[1800][2] += 0.125;
  WriteScan(other);
  const Bytes resumed = EncodedBytes(Resume::kContinue);
  ExpectAnew("the scan has changed");
  EXPECT_EQ(resumed, EncodedBytes(Resume::kNever));
  EXPECT_NE(resumed, whole_);
}

TEST_F(Resumed, NoDamagedFileDecidesABit) {
  Interrupt("seams", 3);
  const fs::path kept = Kept();
  const fs::path copy = folder_.File("copy");
  fs::copy(kept, copy);
  size_t damaged = 0;
  for (const auto& entry : fs::directory_iterator(copy)) {
    // A file of each kind, and the journal.
    const std::string name = entry.path().filename().string();
    if (!name.ends_with(".3") && name != "journal") continue;
    for (const bool cut : {false, true}) {
      PutBack(copy, kept);
      Bytes bytes = FileContent(entry.path().string());
      ASSERT_FALSE(bytes.empty()) << name;
      if (cut) {
        bytes.resize(bytes.size() / 2);
      } else {
        bytes[bytes.size() / 2] ^= 16;
      }
      WriteFile((kept / name).string(), bytes);
      EXPECT_EQ(EncodedBytes(Resume::kContinue), whole_) << name << (cut ? " cut" : " flipped");
      ++damaged;
    }
  }
  EXPECT_GE(damaged, 10U);  // journal, inner, border, positions, faces or cross
}

TEST_F(Resumed, JournalCutAnywhereLosesWhatIsBehind) {
  Interrupt("encode", 1500);
  const fs::path kept = Kept();
  const fs::path copy = folder_.File("copy");
  fs::copy(kept, copy);
  const Bytes journal = FileContent((copy / "journal").string());
  uint64_t resumed = 0;
  for (size_t part = 0; part <= 12; ++part) {
    const size_t size = journal.size() * part / 12;
    PutBack(copy, kept);
    WriteFile((kept / "journal").string(), std::span(journal).first(size));
    EXPECT_EQ(EncodedBytes(Resume::kContinue), whole_) << size;
    EXPECT_GE(report_.resumed_subtrees, resumed) << size;
    resumed = report_.resumed_subtrees;
  }
  EXPECT_GE(resumed, 7U);
}

TEST_F(Resumed, AFolderOfRubbishIsEmptied) {
  Interrupt("encode", 1500);
  const fs::path kept = Kept();
  WriteFile((kept / "journal").string(), std::string_view("rubbish that is longer than a head"));
  fs::create_directories(kept / "folder" / "deep");
  EXPECT_EQ(EncodedBytes(Resume::kContinue), whole_);
  ExpectAnew("damaged");
}

TEST_F(Resumed, AnEncodingAtTheSameTimeGoesItsOwnWay) {
  Interrupt("encode", 1500);
  const fs::path kept = Kept();
  {
    const auto lock =
        io::SpillDirectory::OpenNamed(folder_.File("tmp"), kept.filename().string().substr(8));
    ASSERT_NE(lock, nullptr);
    lock->Keep();
    parallel::Progress progress;
    report_ = Encode(progress, Resume::kContinue).value();
    EXPECT_EQ(report_.resumed_subtrees, 0U);
    EXPECT_EQ(FileContent(folder_.File("out.folp")), whole_);
    fs::remove(folder_.File("out.folp"));
    EXPECT_EQ(support::NamesIn(folder_.File("tmp")),
              std::vector<std::string>{kept.filename().string()});
  }
  EXPECT_EQ(EncodedBytes(Resume::kContinue), whole_);
  EXPECT_GT(report_.resumed_subtrees, 0U);
}

}  // namespace
}  // namespace folprom::hostile
