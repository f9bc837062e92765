#include "io/files/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "support.h"

namespace folprom::io {
namespace {

using testing::FileContent;
using testing::FileSizeLimit;
using testing::TemporaryFolder;
using testing::WriteFile;

std::span<const uint8_t> Bytes(std::string_view text) {
  return {reinterpret_cast<const uint8_t*>(text.data()), text.size()};
}

void ExpectOutputError(const std::string& path, bool force, const std::string& reason) {
  const auto file = AtomicFile::Create(path, force);
  ASSERT_FALSE(file.ok()) << path;
  EXPECT_EQ(file.error().kind, ErrorKind::kOutput);
  EXPECT_NE(file.error().message.find(path), std::string::npos) << file.error().message;
  EXPECT_NE(file.error().message.find(reason), std::string::npos) << file.error().message;
}

TEST(AtomicFile, AppearsWithAllBytesAtCommitAndNotBefore) {
  const TemporaryFolder folder;
  auto file = AtomicFile::Create(folder.File("out"), false).value();
  file->Append(Bytes("head....tail")).value();
  file->WriteAt(4, Bytes("ABCD")).value();
  file->Append(Bytes("!")).value();
  EXPECT_FALSE(std::filesystem::exists(folder.File("out")));
  file->Commit().value();
  file.reset();
  EXPECT_EQ(FileContent(folder.File("out")), "headABCDtail!");
  EXPECT_EQ(folder.Names(), std::vector<std::string>{"out"});
}

TEST(AtomicFile, LeavesTheOldFileUntilCommitAndWhenAbandoned) {
  const TemporaryFolder folder;
  WriteFile(folder.File("out"), "old");
  {
    auto file = AtomicFile::Create(folder.File("out"), true).value();
    file->Append(Bytes("new content")).value();
    EXPECT_EQ(FileContent(folder.File("out")), "old");
  }
  EXPECT_EQ(FileContent(folder.File("out")), "old");
  EXPECT_EQ(folder.Names(), std::vector<std::string>{"out"});
}

TEST(AtomicFile, ReplacesAnExistingFileOnlyWhenForced) {
  const TemporaryFolder folder;
  WriteFile(folder.File("out"), "old");
  ::chmod(folder.File("out").c_str(), 0640);
  ExpectOutputError(folder.File("out"), false, "exists");
  auto file = AtomicFile::Create(folder.File("out"), true).value();
  file->Append(Bytes("new")).value();
  file->Commit().value();
  EXPECT_EQ(FileContent(folder.File("out")), "new");
  struct stat status {};
  ::stat(folder.File("out").c_str(), &status);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
}

TEST(AtomicFile, DoesNotReplaceAFileThatAppearedMeanwhile) {
  const TemporaryFolder folder;
  auto file = AtomicFile::Create(folder.File("out"), false).value();
  WriteFile(folder.File("out"), "somebody else's");
  const Result<void> result = file->Commit();
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::kOutput);
  file.reset();
  EXPECT_EQ(FileContent(folder.File("out")), "somebody else's");
  EXPECT_EQ(folder.Names(), std::vector<std::string>{"out"});
}

TEST(AtomicFile, WritesThroughASymbolicLink) {
  const TemporaryFolder folder;
  WriteFile(folder.File("real"), "old");
  std::filesystem::create_symlink("real", folder.File("link"));
  auto file = AtomicFile::Create(folder.File("link"), true).value();
  file->Append(Bytes("new")).value();
  file->Commit().value();
  EXPECT_TRUE(std::filesystem::is_symlink(folder.File("link")));
  EXPECT_EQ(FileContent(folder.File("real")), "new");
}

TEST(AtomicFile, RefusesASymbolicLinkToNothing) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("missing", folder.File("link"));
  for (const bool force : {false, true}) {
    ExpectOutputError(folder.File("link"), force, "symbolic link to a file that does not exist");
  }
  EXPECT_EQ(folder.Names(), std::vector<std::string>{"link"});
}

TEST(AtomicFile, RefusesTargetsThatCannotBeFiles) {
  const TemporaryFolder folder;
  WriteFile(folder.File("file"), "x");
  ExpectOutputError(folder.path(), true, "is a directory");
  ExpectOutputError(folder.path() + "/", true, "not a file name");
  ExpectOutputError(folder.File("missing/out"), true, "folder");
  ExpectOutputError(folder.File("file/out"), true, "directory");
  ExpectOutputError("/dev/null", true, "not a regular file");
  ExpectOutputError("", true, "not a file name");
}

TEST(AtomicFile, NamesTheFolderThatIsNotWritable) {
  const TemporaryFolder folder;
  ::chmod(folder.path().c_str(), 0555);
  const uid_t user = ::geteuid();
  // The superuser may write anywhere.
  if (user == 0 && ::seteuid(65534) != 0) GTEST_SKIP() << "cannot be an ordinary user";
  ExpectOutputError(folder.File("out"), false, "cannot create a file in " + folder.path());
  ASSERT_EQ(::seteuid(user), 0);
  ::chmod(folder.path().c_str(), 0755);
}

TEST(AtomicFile, CannotCreateAFileWhereTheSystemHasNone) {
  if (!std::filesystem::is_directory("/proc/self")) GTEST_SKIP() << "no /proc here";
  ExpectOutputError("/proc/self/out", false, "cannot create a file in /proc/self");
}

TEST(AtomicFile, ReportsAFullDiskAndLeavesTheOldFile) {
  const TemporaryFolder folder;
  WriteFile(folder.File("out"), "old");
  {
    const FileSizeLimit limit(10000);
    auto file = AtomicFile::Create(folder.File("out"), true).value();
    const Result<void> result = file->Append(Bytes(std::string(20000, 'x')));
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().kind, ErrorKind::kOutput);
    EXPECT_TRUE(result.error().message.starts_with(folder.File("out") + ": cannot write"))
        << result.error().message;
  }
  EXPECT_EQ(FileContent(folder.File("out")), "old");
  EXPECT_EQ(folder.Names(), std::vector<std::string>{"out"});
}

TEST(AtomicFile, RefusesOffsetsBeyondAnyFile) {
  const TemporaryFolder folder;
  auto file = AtomicFile::Create(folder.File("out"), false).value();
  EXPECT_FALSE(file->WriteAt(UINT64_MAX - 1, Bytes("abc")).ok());
}

TEST(AtomicFile, TakesNothingAfterCommit) {
  const TemporaryFolder folder;
  auto file = AtomicFile::Create(folder.File("out"), false).value();
  file->Commit().value();
  EXPECT_FALSE(file->Append(Bytes("x")).ok());
  EXPECT_FALSE(file->Commit().ok());
  EXPECT_EQ(FileContent(folder.File("out")), "");
}

}  // namespace
}  // namespace folprom::io
