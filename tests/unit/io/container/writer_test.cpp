#include "io/container/writer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "io/container/checksum.h"
#include "io/container/reader.h"
#include "samples.h"
#include "tests/support/memory_file.h"

namespace folprom::io {
namespace {

using support::MemoryFile;
using support::WrittenContainer;

uint64_t WriteSample(const FileTable& table, AtomicFile& out) {
  std::vector<uint8_t> bytes;
  return WriteContainer(
      table,
      [&](size_t layer, size_t subtree, SegmentPart part) {
        bytes = SampleSegment(table, layer, subtree, part);
        return std::span<const uint8_t>(bytes);
      },
      out);
}

TEST(ContainerWriter, ReturnsTheSizeOfTheFile) {
  for (uint64_t seed = 0; seed < 50; ++seed) {
    const FileTable table = RandomTable(seed, true);
    MemoryFile file;
    const uint64_t written = WriteSample(table, file);
    EXPECT_EQ(written, file.bytes().size());
  }
}

TEST(ContainerWriter, ACommittedFileOpensAndHasTheBytesOfMemory) {
  const auto folder = std::filesystem::temp_directory_path() /
                      ("folprom_container_test_" + std::to_string(getpid()));
  std::filesystem::create_directory(folder);
  const std::string path = folder / "sample.folp";
  const FileTable table = ScanLikeTable();
  auto file = AtomicFile::Create(path, false).value();
  WriteSample(table, *file);
  file->Commit().value();
  std::ifstream in(path, std::ios::binary);
  const std::vector<uint8_t> bytes(std::istreambuf_iterator<char>(in), {});
  std::filesystem::remove_all(folder);
  EXPECT_TRUE(bytes == SampleFile(table));
  EXPECT_TRUE(ContainerReader::Open(bytes, path).ok());
}

TEST(ContainerWriter, GathersSmallSegmentsAndPassesLargeOnes) {
  FileTable table = ScanLikeTable();
  table.segment_bytes.back() = 3000000;
  MemoryFile file;
  WriteSample(table, file);
  EXPECT_LE(file.appends(), file.bytes().size() / 200000 + 3);
}

TEST(ContainerWriter, AsksForEachSegmentOnceInTheOrderOfTheFile) {
  const FileTable table = ExampleTable();
  std::vector<size_t> asked;
  std::vector<uint8_t> bytes;
  WrittenContainer(table, [&](size_t layer, size_t subtree, SegmentPart part) {
    asked.push_back(table.SegmentIndex(layer, subtree, part));
    bytes = SampleSegment(table, layer, subtree, part);
    return std::span<const uint8_t>(bytes);
  });
  EXPECT_EQ(asked, (std::vector<size_t>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(ContainerWriter, RefusesASegmentOfAnotherLengthThanAnnounced) {
  const std::vector<uint8_t> bytes(20);
  try {
    WrittenContainer(ExampleTable(),
                     [&](size_t, size_t, SegmentPart) { return std::span<const uint8_t>(bytes); });
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.error().kind, ErrorKind::kInternal);
    EXPECT_EQ(failure.error().message,
              "segment of layer 0, subtree 0, seam has 20 bytes, the table says 0");
  }
}

TEST(ContainerWriter, PassesOnThatTheDiskIsFull) {
  MemoryFile file(100);
  try {
    WriteSample(ExampleTable(), file);
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.error().kind, ErrorKind::kOutput);
    EXPECT_EQ(failure.error().message, "disk full");
  }
}

TEST(Checksum, IsXxh3WithoutSeed) { EXPECT_EQ(XxHash64({}), 0x2d06800538d394c2u); }

}  // namespace
}  // namespace folprom::io
