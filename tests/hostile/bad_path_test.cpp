// Paths that cannot be read or written, and outputs that are already there.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "parallel/progress.h"
#include "parallel/runner.h"
#include "tests/hostile/support.h"

namespace folprom::hostile {
namespace fs = std::filesystem;
namespace {

/// Files that are there already, of each ending that an output may have.
constexpr const char* kOld[] = {"old.ply", "old.obj", "old.stl", "old.off"};

class BadPath : public ::testing::Test {
 protected:
  BadPath() {
    WriteFile(folder_.File("scan.ply"), PlyBytes(WavySheet(10)));
    WriteFile(folder_.File("scan.folp"), Encoded(WavySheet(10), SmallOptions()));
    for (const char* name : kOld) WriteFile(folder_.File(name), std::string_view("old"));
    fs::create_directory(folder_.File("folder.ply"));
    before_ = folder_.Names();
  }
  template <class Report>
  static Error ErrorOf(const Result<Report>& report) {
    return report.ok() ? Error{ErrorKind::kUsage, "no error"} : report.error();
  }
  Error Encode(const std::string& input, const std::string& output) {
    EncodeOptions options = SmallOptions();
    options.temporary_folder = folder_.path();
    options.overwrite = overwrite_;
    return ErrorOf(EncodeFile(input, output, options, *runner_, progress_));
  }
  Error Decode(const std::string& input, const std::string& output, bool region = false) {
    DecodeOptions options;
    options.temporary_folder = folder_.path();
    options.overwrite = overwrite_;
    options.use_region = region;
    for (double& hi : options.region_hi) hi = 1;
    return ErrorOf(DecodeFile(input, output, options, *runner_, progress_));
  }
  /// Runs all three ways to write with this output; each must give kOutput and leave all as it was.
  void ExpectOutputError(const std::string& output, const std::string& part) {
    for (const Error& error :
         {Encode(folder_.File("scan.ply"), output), Decode(folder_.File("scan.folp"), output),
          Decode(folder_.File("scan.folp"), output, true)}) {
      EXPECT_EQ(error.kind, ErrorKind::kOutput) << error.message;
      EXPECT_NE(error.message.find(part), std::string::npos) << error.message;
      EXPECT_EQ(folder_.Names(), before_);
      for (const char* name : kOld) {
        EXPECT_EQ(FileContent(folder_.File(name)), (Bytes{'o', 'l', 'd'}));
      }
    }
  }
  void ExpectInputError(const std::string& input) {
    const std::string out = folder_.File("out.ply");
    auto verified = VerifyFile(input, "", {}, *runner_, progress_);
    auto info = ReadInfo(input);
    for (const Error& error : {Encode(input, out), Decode(input, out), Decode(input, out, true),
                               ErrorOf(verified), ErrorOf(info)}) {
      EXPECT_EQ(error.kind, ErrorKind::kInput) << error.message;
      EXPECT_NE(error.message.find(input), std::string::npos) << error.message;
      EXPECT_EQ(folder_.Names(), before_);
    }
  }

  TemporaryFolder folder_;
  std::vector<std::string> before_;
  bool overwrite_ = false;
  std::unique_ptr<parallel::Runner> runner_ = parallel::MakeSerialRunner();
  parallel::Progress progress_;
};

TEST_F(BadPath, OutputThatExistsIsKept) {
  for (const char* name : kOld) ExpectOutputError(folder_.File(name), folder_.File(name));
}

TEST_F(BadPath, OutputInAMissingFolderIsRefused) {
  for (const char* name : {"missing/out.ply", "missing/out.obj", "missing/out.stl"}) {
    ExpectOutputError(folder_.File(name), "missing");
  }
}

TEST_F(BadPath, OutputThatIsAFolderIsRefusedEvenByForce) {
  ExpectOutputError(folder_.File("folder.ply"), folder_.File("folder.ply"));
  overwrite_ = true;
  ExpectOutputError(folder_.File("folder.ply"), folder_.File("folder.ply"));
}

TEST_F(BadPath, OutputBelowAFileIsRefused) {
  ExpectOutputError(folder_.File("old.ply/out.ply"), folder_.File("old.ply"));
}

TEST_F(BadPath, OutputThatExistsIsReplacedByForce) {
  overwrite_ = true;
  EXPECT_EQ(Encode(folder_.File("scan.ply"), folder_.File("old.ply")).message, "no error");
  EXPECT_EQ(FileContent(folder_.File("old.ply")), FileContent(folder_.File("scan.folp")));
  for (const char* name : kOld) {
    EXPECT_EQ(Decode(folder_.File("scan.folp"), folder_.File(name)).message, "no error");
    EXPECT_GT(fs::file_size(folder_.File(name)), 1000u);
  }
  EXPECT_EQ(folder_.Names(), before_);
}

TEST_F(BadPath, OutputOfAnUnknownEndingIsAUsageError) {
  for (const char* name : {"out", "out.3ds", "out.ply.gz", ".ply", "ply", "out.plyx"}) {
    for (const bool region : {false, true}) {
      const Error error = Decode(folder_.File("scan.folp"), folder_.File(name), region);
      EXPECT_EQ(error.kind, ErrorKind::kUsage) << error.message;
      EXPECT_NE(error.message.find("(known: .ply, .obj, .stl, .off)"), std::string::npos);
      EXPECT_EQ(folder_.Names(), before_);
    }
  }
}

TEST_F(BadPath, InputThatIsMissingIsRefused) { ExpectInputError(folder_.File("missing")); }
TEST_F(BadPath, InputThatIsAFolderIsRefused) { ExpectInputError(folder_.File("folder.ply")); }
TEST_F(BadPath, InputOfAnotherKindIsRefused) {
  for (const char* name : kOld) ExpectInputError(folder_.File(name));
}
TEST_F(BadPath, InputThatIsADeviceOrAPipeIsRefusedAtOnce) {
  ExpectInputError("/dev/null");
  for (const char* name : {"pipe", "pipe.obj", "pipe.stl", "pipe.off"}) {
    ASSERT_EQ(::mkfifo(folder_.File(name).c_str(), 0600), 0);
    before_ = folder_.Names();
    ExpectInputError(folder_.File(name));
  }
}

TEST_F(BadPath, MissingTemporaryFolderIsRefused) {
  EncodeOptions options = SmallOptions();
  options.temporary_folder = folder_.File("missing");
  auto report =
      EncodeFile(folder_.File("scan.ply"), folder_.File("out.ply"), options, *runner_, progress_);
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().kind, ErrorKind::kOutput) << report.error().message;
  EXPECT_NE(report.error().message.find("missing"), std::string::npos);
  EXPECT_EQ(folder_.Names(), before_);
}

TEST_F(BadPath, OptionsThatContradictThemselvesAreRefused) {
  DecodeOptions two_bounds;
  two_bounds.layers = 2;
  two_bounds.max_vertices = 10;
  DecodeOptions inside_out;
  inside_out.use_region = true;
  inside_out.region_lo[1] = 1;
  for (const DecodeOptions& options : {two_bounds, inside_out}) {
    auto report = DecodeFile(folder_.File("scan.folp"), folder_.File("out.ply"), options, *runner_,
                             progress_);
    ASSERT_FALSE(report.ok());
    EXPECT_EQ(report.error().kind, ErrorKind::kUsage);
    EXPECT_EQ(folder_.Names(), before_);
  }
  EncodeOptions wrong = SmallOptions();
  wrong.codec.children = 1;
  auto report =
      EncodeFile(folder_.File("scan.ply"), folder_.File("out.ply"), wrong, *runner_, progress_);
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().kind, ErrorKind::kUsage);
  EXPECT_EQ(folder_.Names(), before_);
}

}  // namespace
}  // namespace folprom::hostile
