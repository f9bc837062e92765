#include "io/files/mapped_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "support.h"

namespace folprom::io {
namespace {

using testing::TemporaryFolder;
using testing::WriteFile;

TEST(MappedFile, GivesTheBytesOfTheFile) {
  const TemporaryFolder folder;
  WriteFile(folder.File("a"), "hello");
  const Result<MappedFile> opened = MappedFile::Open(folder.File("a"));
  ASSERT_TRUE(opened.ok());
  Result<MappedFile> copy = MappedFile::Open(folder.File("a"));
  MappedFile moved = std::move(copy).value();
  const auto bytes = moved.bytes();
  EXPECT_EQ(std::string(bytes.begin(), bytes.end()), "hello");
  EXPECT_EQ(moved.path(), folder.File("a"));
}

TEST(MappedFile, ReadsTheSameBytesAfterItsPagesWereDropped) {
  const TemporaryFolder folder;
  std::string content(300000, 'x');
  for (size_t i = 0; i < content.size(); ++i) content[i] = static_cast<char>(i * 7);
  WriteFile(folder.File("a"), content);
  const MappedFile file = MappedFile::Open(folder.File("a")).value();
  file.DropResident(5000, 100000);
  file.DropResident(0, size_t{1} << 60);
  file.DropResident(10, 10);
  file.DropResident();
  EXPECT_EQ(std::string(file.bytes().begin(), file.bytes().end()), content);
}

TEST(MappedFile, GivesAnEmptySpanForAnEmptyFile) {
  const TemporaryFolder folder;
  WriteFile(folder.File("empty"), "");
  const MappedFile file = MappedFile::Open(folder.File("empty")).value();
  EXPECT_TRUE(file.bytes().empty());
  file.DropResident();
}

TEST(MappedFile, NamesThePathOfWhatItCannotOpen) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo(folder.File("pipe").c_str(), 0600), 0);
  for (const std::string& path : {folder.File("missing"), folder.path(), folder.File("pipe"),
                                  folder.File("missing/deeper"), std::string()}) {
    const Result<MappedFile> file = MappedFile::Open(path);
    ASSERT_FALSE(file.ok()) << path;
    EXPECT_EQ(file.error().kind, ErrorKind::kInput);
    EXPECT_TRUE(file.error().message.starts_with(path + ": ")) << file.error().message;
  }
}

}  // namespace
}  // namespace folprom::io
