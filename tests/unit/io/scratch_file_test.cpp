#include "io/files/scratch_file.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "io/files/atomic_file.h"
#include "support.h"

namespace folprom::io {
namespace {

using testing::TemporaryFolder;

std::vector<uint8_t> Counting(size_t size) {
  std::vector<uint8_t> bytes(size);
  for (size_t i = 0; i < size; ++i) bytes[i] = static_cast<uint8_t>(i * 7);
  return bytes;
}

TEST(ScratchFile, HoldsWhatWasAppendedAndHasNoName) {
  const TemporaryFolder folder;
  ScratchFile file(folder.path(), "out");
  EXPECT_TRUE(file.Map().bytes().empty());
  const std::vector<uint8_t> bytes = Counting(100000);
  file.Append(std::span(bytes).first(1));
  file.Append(std::span(bytes).subspan(1));
  EXPECT_EQ(file.size(), bytes.size());
  EXPECT_TRUE(std::ranges::equal(file.Map().bytes(), bytes));
  EXPECT_TRUE(folder.Names().empty());
}

TEST(ScratchFile, IsAppendedToAnOutput) {
  const TemporaryFolder folder;
  const std::vector<uint8_t> bytes = Counting(300001);
  ScratchFile scratch(folder.path(), "out");
  scratch.Append(bytes);
  auto file = AtomicFile::Create(folder.File("out"), false).value();
  EXPECT_EQ(file->folder(), folder.path());
  file->Append(std::span(bytes).first(3)).value();
  file->AppendFrom(scratch).value();
  file->AppendFrom(ScratchFile(folder.path(), "out")).value();
  file->Append(std::span(bytes).first(2)).value();
  file->Commit().value();
  std::string expected;
  for (const auto& piece : {std::span(bytes).first(3), std::span(bytes).first(bytes.size()),
                            std::span(bytes).first(2)}) {
    expected.append(piece.begin(), piece.end());
  }
  EXPECT_TRUE(testing::FileContent(folder.File("out")) == expected);
}

TEST(ScratchFile, ReportsAMissingFolderAndAFullDisk) {
  const TemporaryFolder folder;
  EXPECT_THROW(ScratchFile(folder.File("missing"), "out"), Failure);
  ScratchFile file(folder.path(), "out");
  const testing::FileSizeLimit limit(1000);
  EXPECT_THROW(file.Append(Counting(2000)), Failure);
}

}  // namespace
}  // namespace folprom::io
