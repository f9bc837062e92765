// The inputs that the fuzz targets start from, and those that once broke one.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "folprom/decoder.h"
#include "tests/fuzz/folp_check.h"
#include "tests/fuzz/scan_check.h"
#include "tests/hostile/guarded_child.h"
#include "tests/hostile/support.h"

namespace folprom::hostile {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> FilesIn(const std::string& folder) {
  std::vector<std::string> files;
  const std::string path = FOLPROM_SOURCE_DIR "/tests/fuzz/" + folder;
  if (!fs::is_directory(path)) return files;  // nothing has broken this target yet
  for (const auto& entry : fs::directory_iterator(path)) {
    files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string FaultOf(const std::string& target, const Bytes& input) {
  if (target == "folp") return fuzz::FaultOfFolp(input);
  if (target == "ply") return fuzz::ReadScanBytes(input, "scan.ply").fault;
  return fuzz::ReadTextInput(input).fault;
}

TEST(FuzzInput, SeedsAreWhatTheirReadersTake) {
  for (const std::string target : {"folp", "ply", "text"}) {
    EXPECT_GE(FilesIn("seeds/" + target).size(), 5u);
  }
  for (const std::string& file : FilesIn("seeds/folp")) {
    const Bytes bytes = FileContent(file);
    ErrorKind error;
    const std::vector<Lod> lods = DecodeLods(bytes, &error);
    EXPECT_EQ(lods.size(), MemoryDecoder::Open(bytes).value().layer_count()) << file;
    EXPECT_EQ(fuzz::FaultOfFolp(bytes), "") << file;
  }
  for (const std::string& file : FilesIn("seeds/ply")) {
    const fuzz::ScanOutcome outcome = fuzz::ReadScan(file);
    EXPECT_TRUE(outcome.is_mesh) << outcome.error;
    EXPECT_EQ(outcome.fault, "") << file;
  }
  for (const std::string& file : FilesIn("seeds/text")) {
    const fuzz::ScanOutcome outcome = fuzz::ReadTextInput(FileContent(file));
    EXPECT_TRUE(outcome.is_mesh) << file << ": " << outcome.error;
    EXPECT_EQ(outcome.fault, "") << file;
  }
}

TEST(FuzzInput, RepairOfAWholeFileChangesNothing) {
  for (const std::string& file : FilesIn("seeds/folp")) {
    const Bytes bytes = FileContent(file);
    Bytes repaired = bytes;
    fuzz::RepairChecksums(&repaired);
    EXPECT_EQ(repaired, bytes) << file;
  }
}

TEST(FuzzInput, RepairMakesDamageReachTheDecoder) {
  const Bytes whole = SmallFile(Hierarchy::kQuadric);
  size_t decoded = 0;
  for (size_t at = whole.size() / 2; at < whole.size() / 2 + 100; ++at) {
    Bytes damaged = whole;
    damaged[at] = static_cast<uint8_t>(damaged[at] ^ 4);
    EXPECT_FALSE(damaged == whole);
    fuzz::RepairChecksums(&damaged);
    const auto decoder = MemoryDecoder::Open(damaged);
    decoded += decoder.ok();
    EXPECT_EQ(fuzz::FaultOfFolp(damaged), "") << at;
  }
  EXPECT_GT(decoded, 90u);
}

TEST(FuzzInput, ThatOnceBrokeATargetEndsWell) {
  for (const std::string target : {"folp", "ply", "text"}) {
    const std::vector<std::string> files = FilesIn("crashes/" + target);
    const std::string faults = RunGuarded(files.size(), 5, uint64_t{64} << 20, [&](size_t i) {
      const std::string fault = FaultOf(target, FileContent(files[i]));
      if (!fault.empty()) std::fprintf(stderr, "%s: %s\n", files[i].c_str(), fault.c_str());
      return fault.empty();
    });
    EXPECT_EQ(faults, "") << target;
  }
}

}  // namespace
}  // namespace folprom::hostile
