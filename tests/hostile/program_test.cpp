// The program itself over damaged inputs of every format: a right mesh, or a message and the exit
// code of its kind; within 64 MiB and 64 times the input, and within a second.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "tests/hostile/guarded_child.h"
#include "tests/hostile/program_run.h"
#include "tests/hostile/small_scans.h"
#include "tests/hostile/support.h"
#include "tests/support/memory_file.h"

namespace folprom::hostile {
namespace fs = std::filesystem;
namespace {

constexpr int kInput = 3, kCorrupt = 4, kLimit = 6;

#ifdef NDEBUG
constexpr bool kIsOptimised = true;
#else
constexpr bool kIsOptimised = false;
#endif

class Program : public ::testing::Test {
 protected:
  Program() : idle_bytes_(RunProgram({"--version"}, folder_.path()).peak_bytes) {}

  /// Empty where the run kept the promise: ended by itself with one of `codes`; said why where it
  /// failed, with the name of the input; took no more than it may.
  std::string FaultOf(const std::vector<std::string>& arguments, const std::string& input,
                      const std::set<int>& codes) {
    const ProgramRun run = RunProgram(arguments, folder_.path());
    exit_code_ = run.exit_code;
    const uint64_t bytes = fs::file_size(input);
    const std::string verb = arguments.front() + " " + fs::path(input).filename().string() + ": ";
    if (run.exit_code < 0) return verb + "ended by signal " + std::to_string(run.signal);
    if (!codes.contains(run.exit_code)) {
      return verb + "exit code " + std::to_string(run.exit_code) + ", " + run.err;
    }
    const std::string name = fs::path(input).filename().string();
    if (run.exit_code != 0 &&
        (!run.err.starts_with("folprom: ") || run.err.find(name) == std::string::npos)) {
      return verb + "no clear message: " + run.err;
    }
    const uint64_t growth = run.peak_bytes - std::min(run.peak_bytes, idle_bytes_);
    if (kMeasuresMemory && growth > (uint64_t{64} << 20) + 64 * bytes) {
      return verb + "memory grows by " + std::to_string(growth >> 20) + " MiB";
    }
    // Of processor time, which other programs do not lengthen.
    if (kMeasuresMemory && kIsOptimised && run.cpu_seconds > 1) {
      return verb + std::to_string(run.cpu_seconds) + " s";
    }
    return {};
  }

  /// Of encoding it, and of what comes back.
  std::string FaultOfScan(const std::string& scan) {
    const std::string folp = folder_.File("scan.folp");
    std::string fault = FaultOf({"encode", scan, "-o", folp, "-q", "-T", "1", "--exact"}, scan,
                                {0, kInput, kLimit});
    if (!fault.empty()) return fault;
    if (exit_code_ != 0) return fs::exists(folp) ? scan + ": an output is left" : "";
    fault = FaultOf({"verify", folp, "--against", scan, "-q", "-T", "1"}, scan, {0});
    fs::remove(folp);
    return fault;
  }

  std::string FaultOfFolp(const std::string& folp) {
    const std::string ply = folder_.File("out.ply");
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"decode", folp, "-o", ply, "-q", "-T", "1"},
          {"verify", folp, "-q", "-T", "1"},
          {"info", folp, "-q"}}) {
      const std::string fault = FaultOf(arguments, folp, {0, kInput, kCorrupt, kLimit});
      if (!fault.empty()) return fault;
      if (exit_code_ != 0 && fs::exists(ply)) return folp + ": an output is left";
      fs::remove(ply);
    }
    return {};
  }

  /// Cut at some places, and with some bits flipped.
  template <class FaultOf>
  void ExpectNoFaultOfDamaged(const std::string& name, const Bytes& whole, FaultOf fault_of) {
    const std::string path = folder_.File(name);
    const auto expect_none = [&](const Bytes& bytes, const std::string& what) {
      WriteFile(path, bytes);
      EXPECT_EQ(fault_of(path), "") << what;
    };
    const size_t step = std::max<size_t>(whole.size() / 8, 1);
    for (size_t bytes = step / 2; bytes < whole.size(); bytes += step) {
      expect_none({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(bytes)},
                  "cut at " + std::to_string(bytes));
    }
    for (size_t byte = step / 3; byte < whole.size(); byte += step) {
      Bytes flipped = whole;
      flipped[byte] = static_cast<uint8_t>(flipped[byte] ^ (1u << byte % 8));
      expect_none(flipped, "flipped in byte " + std::to_string(byte));
    }
    fs::remove(path);
  }

  TemporaryFolder folder_;
  uint64_t idle_bytes_;
  int exit_code_ = 0;  ///< of the last run
};

TEST_F(Program, KeepsThePromiseOverTheMalformedSharedFiles) {
  if (SharedData().empty()) GTEST_SKIP() << "no shared data: set FOLPROM_SHARED";
  std::vector<std::string> scans;
  for (const auto& entry : fs::directory_iterator(SharedData() + "malformed")) {
    scans.push_back(entry.path().string());
  }
  std::ranges::sort(scans);
  ASSERT_FALSE(scans.empty());
  for (const std::string& scan : scans) EXPECT_EQ(FaultOfScan(scan), "");
}

TEST_F(Program, KeepsThePromiseOverDamagedScansOfEveryFormat) {
  for (const SmallScan& scan : SmallScans()) {
    SCOPED_TRACE(scan.name);
    const Bytes whole(scan.bytes.begin(), scan.bytes.end());
    WriteFile(folder_.File(scan.name), whole);
    EXPECT_EQ(FaultOfScan(folder_.File(scan.name)), "");
    ExpectNoFaultOfDamaged(scan.name, whole,
                           [this](const std::string& path) { return FaultOfScan(path); });
  }
}

TEST_F(Program, KeepsThePromiseOverDamagedFiles) {
  const Bytes& whole = SmallFile(Hierarchy::kQuadric);
  WriteFile(folder_.File("whole.folp"), whole);
  EXPECT_EQ(FaultOfFolp(folder_.File("whole.folp")), "");
  EXPECT_EQ(exit_code_, 0);
  ExpectNoFaultOfDamaged("damaged.folp", whole,
                         [this](const std::string& path) { return FaultOfFolp(path); });
}

/// A whole file whose table has more than eight sizes in each byte, all 0.
Bytes FileOfManySizes() {
  io::FileTable table = TakeApart(SmallFile(Hierarchy::kQuadric)).table;
  table.subtrees.assign(700, {1, {}, {}, {}});
  table.vertices = table.subtrees.size();
  table.layers.assign(io::kMaxLayers, {});
  table.segment_bytes.assign(2 * table.subtrees.size() * table.layers.size(), 0);
  return support::WrittenContainer(
      table, [](size_t, size_t, io::SegmentPart) { return std::span<const uint8_t>(); });
}

TEST_F(Program, RefusesATableThatWouldTakeMoreMemoryThanItsFileMay) {
  const std::string path = folder_.File("sizes.folp");
  WriteFile(path, FileOfManySizes());
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"info", path},
        {"verify", path},
        {"decode", path, "-o", folder_.File("out.ply")}}) {
    EXPECT_EQ(FaultOf(arguments, path, {kLimit}), "");
  }
}

TEST_F(Program, NamesTheKindOfWhatItRefuses) {
  WriteFile(folder_.File("a.ply"), std::string_view("ply\nformat ascii 1.0\n"));
  FaultOfScan(folder_.File("a.ply"));
  EXPECT_EQ(exit_code_, kInput);
  WriteFile(folder_.File("b.txt"), std::string_view("nothing known"));
  const ProgramRun unknown =
      RunProgram({"encode", folder_.File("b.txt"), "-o", folder_.File("b.folp")}, folder_.path());
  EXPECT_EQ(unknown.exit_code, kInput);
  EXPECT_NE(unknown.err.find("PLY, OBJ, STL, OFF"), std::string::npos) << unknown.err;
  Bytes damaged = SmallFile(Hierarchy::kQuadric);
  damaged[damaged.size() / 2] ^= 1;
  WriteFile(folder_.File("c.folp"), damaged);
  FaultOf({"verify", folder_.File("c.folp"), "-q"}, folder_.File("c.folp"), {kCorrupt});
  EXPECT_EQ(exit_code_, kCorrupt);
}

}  // namespace
}  // namespace folprom::hostile
