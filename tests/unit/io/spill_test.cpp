#include "io/spill/spill.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <functional>

#include "io/files/atomic_file.h"
#include "support.h"

namespace folprom::io {
namespace {

using testing::FileSizeLimit;
using testing::TemporaryFolder;

TEST(SpillDirectory, IsPrivateAndGoesWithAllInIt) {
  const TemporaryFolder parent;
  std::string path;
  {
    const SpillDirectory first(parent.path());
    const SpillDirectory second(parent.path());
    EXPECT_NE(first.path(), second.path());
    path = first.path();
    WriteSpillFile(first, "some", {});
    std::filesystem::create_directory(first.File("folder"));
    EXPECT_EQ(std::filesystem::status(path).permissions(), std::filesystem::perms::owner_all);
  }
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_TRUE(parent.Names().empty());
}

TEST(SpillDirectory, NamesAParentThatIsMissing) {
  const TemporaryFolder parent;
  try {
    const SpillDirectory directory(parent.File("missing"));
    FAIL() << "no error";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.error().kind, ErrorKind::kOutput);
    EXPECT_NE(failure.error().message.find(parent.File("missing")), std::string::npos);
  }
}

TEST(SpillDirectory, FollowsTheTemporaryFolderOfTheUser) {
  const TemporaryFolder parent;
  const char* variable = std::getenv("TMPDIR");
  const std::string old = variable != nullptr ? variable : "";
  ::setenv("TMPDIR", parent.path().c_str(), 1);
  const std::string path = SpillDirectory("").path();
  old.empty() ? ::unsetenv("TMPDIR") : ::setenv("TMPDIR", old.c_str(), 1);
  EXPECT_TRUE(path.starts_with(parent.path() + "/folprom-")) << path;
}

TEST(SpillDirectory, NamedOneIsTakenOverOnceItsOwnerIsGone) {
  const TemporaryFolder parent;
  {
    const auto first = SpillDirectory::OpenNamed(parent.path(), "job");
    ASSERT_NE(first, nullptr);
    EXPECT_EQ(first->path(), parent.File("folprom-job"));
    EXPECT_EQ(SpillDirectory::OpenNamed(parent.path(), "job"), nullptr);
    WriteSpillFile(*first, "some", std::vector<uint8_t>(5));
    first->Keep();
  }
  {
    const auto second = SpillDirectory::OpenNamed(parent.path(), "job");
    ASSERT_NE(second, nullptr);
    EXPECT_EQ(second->FileBytes("some"), 5U);
    second->Clear();
    EXPECT_EQ(second->SizeBytes(), 0U);
    EXPECT_THROW(second->FileBytes("some"), Failure);
  }
  EXPECT_TRUE(parent.Names().empty());
}

TEST(SpillDirectory, NamedOneThatOthersCouldReadOrThatIsNoFolderIsLeftAlone) {
  const TemporaryFolder parent;
  std::filesystem::create_directory(parent.File("folprom-open"));
  std::filesystem::permissions(parent.File("folprom-open"), std::filesystem::perms(0755));
  std::filesystem::create_directory_symlink(parent.path(), parent.File("folprom-link"));
  WriteWholeFile(parent.File("folprom-file"), "text", false).value();
  const auto before = parent.Names();
  for (const char* name : {"open", "link", "file"}) {
    EXPECT_EQ(SpillDirectory::OpenNamed(parent.path(), name), nullptr) << name;
  }
  EXPECT_EQ(parent.Names(), before);
}

TEST(SpillStreams, FinishedOnesOfAKeptFolderAreMappedAgain) {
  const TemporaryFolder parent;
  const SpillDirectory directory(parent.path());
  {
    SpillStreams streams(directory, "chunk", 3, 1 << 16);
    for (uint32_t i = 0; i < 10000; ++i) streams.AppendValue(i % 2, i);
    streams.Finish();
  }
  const SpillStreams again(directory, "chunk", std::vector<uint64_t>{20000, 20000, 0});
  const MappedFile odd = again.Map(1);
  EXPECT_EQ(MappedArray<uint32_t>(odd)[4999], 9999U);
  EXPECT_TRUE(again.Map(2).bytes().empty());
  const SpillStreams longer(directory, "chunk", std::vector<uint64_t>{20004});
  EXPECT_THROW(longer.Map(0), Failure);
}

// Streams of many lengths, written in an order that jumps between them.
void RoundTrip(size_t stream_count, uint64_t buffer_bytes, size_t rounds) {
  const TemporaryFolder parent;
  const SpillDirectory directory(parent.path());
  SpillStreams streams(directory, "chunk", stream_count, buffer_bytes);
  std::vector<uint64_t> expected_sizes(stream_count, 0);
  for (uint64_t round = 0; round < rounds; ++round) {
    for (size_t i = 0; i < stream_count; ++i) {
      const size_t stream = (i * 7919) % stream_count;
      if (stream % 5 == 4) continue;  // these stay empty
      for (uint64_t k = 0; k <= stream % 3; ++k) {
        streams.AppendValue(stream, uint64_t{stream} << 32 | expected_sizes[stream]);
        ++expected_sizes[stream];
      }
    }
  }
  streams.Finish();
  for (size_t stream = 0; stream < stream_count; ++stream) {
    const MappedFile file = streams.Map(stream);
    const std::span<const uint64_t> values = MappedArray<uint64_t>(file);
    ASSERT_EQ(values.size(), expected_sizes[stream]);
    for (uint64_t i = 0; i < values.size(); ++i) {
      ASSERT_EQ(values[i], uint64_t{stream} << 32 | i);
    }
  }
}

TEST(SpillStreams, BringsBackTwoThousandStreams) { RoundTrip(2000, 16 << 20, 700); }

TEST(SpillStreams, BringsBackStreamsWithFarTooLittleMemory) { RoundTrip(300, 20000, 20); }

TEST(SpillStreams, BringsBackStreamsWithNoMemory) { RoundTrip(50, 0, 10); }

TEST(SpillStreams, TakesAppendsLargerThanItsBuffer) {
  const TemporaryFolder parent;
  const SpillDirectory directory(parent.path());
  SpillStreams streams(directory, "s", 2, 8192);
  std::vector<uint8_t> expected;
  for (const size_t size : {10u, 4095u, 4096u, 1u, 0u, 100000u, 4097u, 3u}) {
    const std::vector<uint8_t> piece(size, static_cast<uint8_t>(size % 251));
    streams.Append(1, piece.data(), piece.size());
    expected.insert(expected.end(), piece.begin(), piece.end());
  }
  streams.Finish();
  const MappedFile file = streams.Map(1);
  EXPECT_EQ(std::vector<uint8_t>(file.bytes().begin(), file.bytes().end()), expected);
}

TEST(SpillStreams, HasNoFileForAnEmptyStream) {
  const TemporaryFolder parent;
  const SpillDirectory directory(parent.path());
  SpillStreams streams(directory, "s", 3, 1 << 20);
  streams.AppendValue(1, 5);
  streams.Append(2, nullptr, 0);
  streams.Finish();
  EXPECT_TRUE(streams.Map(0).bytes().empty());
  EXPECT_TRUE(streams.Map(2).bytes().empty());
  EXPECT_FALSE(std::filesystem::exists(directory.File("s.0")));
  EXPECT_FALSE(std::filesystem::exists(directory.File("s.2")));
  EXPECT_TRUE(std::filesystem::exists(directory.File("s.1")));
}

TEST(SpillStreams, NamesTheFileThatDoesNotFitOnTheDisk) {
  const TemporaryFolder parent;
  const SpillDirectory directory(parent.path());
  SpillStreams streams(directory, "s", 2, 1 << 20);
  const std::vector<uint8_t> bytes(1 << 20, 1);
  const FileSizeLimit limit(1000);
  for (const bool whole : {true, false}) {
    try {
      if (whole) {
        WriteSpillFile(directory, "s.1", bytes);
      } else {
        streams.Append(1, bytes.data(), bytes.size());
        streams.Finish();
      }
      ADD_FAILURE() << "no error";
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.error().kind, ErrorKind::kOutput);
      EXPECT_TRUE(failure.error().message.starts_with(directory.File("s.1")));
    }
  }
}

TEST(SpillFile, HoldsTheLastBytesWritten) {
  const TemporaryFolder parent;
  const SpillDirectory directory(parent.path());
  WriteSpillFile(directory, "f", std::vector<uint8_t>{1, 2, 3});
  WriteSpillFile(directory, "f", std::vector<uint8_t>{4, 5});
  EXPECT_EQ(testing::FileContent(directory.File("f")), "\4\5");
}

TEST(SpillFile, ThatIsGoneIsAFaultOfTheTemporaryDisk) {
  const TemporaryFolder parent;
  const SpillDirectory directory(parent.path());
  SpillStreams streams(directory, "s", 1, 1 << 20);
  streams.AppendValue(0, 5);
  streams.Finish();
  EXPECT_EQ(directory.SizeBytes(), sizeof(int));
  std::filesystem::remove_all(directory.path());
  for (const auto& use : {std::function<void()>([&] { MapSpillFile(directory.File("s.0")); }),
                          std::function<void()>([&] { streams.Map(0); }),
                          std::function<void()>([&] { directory.SizeBytes(); })}) {
    try {
      use();
      ADD_FAILURE() << "no error";
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.error().kind, ErrorKind::kOutput);
      EXPECT_NE(failure.error().message.find(directory.path()), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace folprom::io
