// A file cut at any byte is the mesh of its complete layers, or corrupt.
#include <gtest/gtest.h>

#include <set>

#include "io/container/reader.h"
#include "parallel/progress.h"
#include "parallel/runner.h"
#include "tests/hostile/support.h"

namespace folprom::hostile {
namespace {

std::span<const uint8_t> Cut(const Bytes& file, size_t bytes) {
  return std::span<const uint8_t>(file).first(bytes);
}

class CutFile : public SmallFileTest {
 protected:
  static size_t HeaderBytes() {
    return io::ContainerReader::Open(SmallFile(), "whole").value().header_bytes();
  }

  /// Byte positions around the end of the header and of every layer, the only ones at which what
  /// decodes can change, and some between.
  static std::set<size_t> InterestingCuts() {
    auto container = io::ContainerReader::Open(SmallFile(), "whole").value();
    std::set<size_t> cuts{0, 1, container.header_bytes() - 1, container.header_bytes()};
    for (size_t layer = 0; layer < container.table().layers.size(); ++layer) {
      for (size_t near : {0u, 1u}) cuts.insert(container.LayerEnd(layer) - near);
    }
    for (size_t cut = 0; cut < SmallFile().size(); cut += 97) cuts.insert(cut);
    return cuts;
  }
};
INSTANTIATE_TEST_SUITE_P(Coder, CutFile, support::EveryCoder(), support::NameOfCoder);

TEST_P(CutFile, HasSeveralSubtreesSeamsAndLayers) {
  const Parts parts = TakeApart(SmallFile());
  EXPECT_GE(parts.table.subtrees.size(), 3u);
  EXPECT_GE(parts.table.layers.size(), 8u);
  EXPECT_FALSE(parts.table.subtrees.back().lower_neighbours.empty());
  ErrorKind error;
  const auto lods = DecodeLods(SmallFile(), &error);
  ASSERT_EQ(lods.size(), parts.table.layers.size());
  EXPECT_EQ(lods.back().positions.size(), 302u);
  EXPECT_EQ(lods.back().faces.size(), 604u);
}

TEST_P(CutFile, InsideTheHeaderIsCorruptAtEveryByte) {
  for (size_t bytes = 0; bytes < HeaderBytes(); ++bytes) {
    auto decoder = MemoryDecoder::Open(Cut(SmallFile(), bytes));
    ASSERT_FALSE(decoder.ok()) << bytes;
    ASSERT_EQ(decoder.error().kind, ErrorKind::kCorrupt)
        << bytes << ": " << decoder.error().message;
  }
}

TEST_P(CutFile, GivesTheMeshOfItsCompleteLayersAtEveryByte) {
  ErrorKind error;
  const auto whole = DecodeLods(SmallFile(), &error);
  auto container = io::ContainerReader::Open(SmallFile(), "whole").value();
  for (size_t bytes = HeaderBytes(); bytes < SmallFile().size(); ++bytes) {
    size_t complete = 0;
    while (complete < whole.size() && container.LayerEnd(complete) <= bytes) ++complete;
    // A copy of its own, so that a sanitizer sees a read beyond the cut.
    const Bytes cut(SmallFile().begin(), SmallFile().begin() + static_cast<ptrdiff_t>(bytes));
    const auto lods = DecodeLods(cut, &error);
    ASSERT_EQ(lods.size(), complete) << bytes;
    if (complete < whole.size()) {
      ASSERT_EQ(error, ErrorKind::kCorrupt) << bytes;
    }
    for (size_t layer = 0; layer < complete; ++layer) ASSERT_TRUE(lods[layer] == whole[layer]);
  }
}

TEST_P(CutFile, DecodesToTheFileOfItsCompleteLayers) {
  TemporaryFolder folder;
  auto runner = parallel::MakeSerialRunner();
  parallel::Progress progress;
  auto container = io::ContainerReader::Open(SmallFile(), "whole").value();
  WriteFile(folder.File("whole.folp"), SmallFile());
  for (size_t bytes : InterestingCuts()) {
    size_t complete = 0;
    while (complete < container.table().layers.size() && container.LayerEnd(complete) <= bytes) {
      ++complete;
    }
    WriteFile(folder.File("cut.folp"), Cut(SmallFile(), bytes));
    DecodeOptions options;
    options.temporary_folder = folder.path();
    auto report =
        DecodeFile(folder.File("cut.folp"), folder.File("cut.ply"), options, *runner, progress);
    if (complete == 0) {
      ASSERT_FALSE(report.ok()) << bytes;
      EXPECT_EQ(report.error().kind, ErrorKind::kCorrupt) << bytes << report.error().message;
      EXPECT_EQ(folder.Names(), (std::vector<std::string>{"cut.folp", "whole.folp"})) << bytes;
      continue;
    }
    ASSERT_TRUE(report.ok()) << bytes << report.error().message;
    EXPECT_EQ(report->layers, complete);
    EXPECT_EQ(report->complete, complete == report->layers_total);
    EXPECT_EQ(report->warnings.empty(), report->complete) << bytes;
    options.layers = static_cast<uint32_t>(complete);
    ASSERT_TRUE(
        DecodeFile(folder.File("whole.folp"), folder.File("same.ply"), options, *runner, progress)
            .ok());
    EXPECT_EQ(FileContent(folder.File("cut.ply")), FileContent(folder.File("same.ply"))) << bytes;
    std::remove(folder.File("cut.ply").c_str());
    std::remove(folder.File("same.ply").c_str());
  }
  EXPECT_EQ(folder.Names(), (std::vector<std::string>{"cut.folp", "whole.folp"}));
}

TEST_P(CutFile, InfoTellsWhatIsThere) {
  TemporaryFolder folder;
  auto container = io::ContainerReader::Open(SmallFile(), "whole").value();
  const size_t layers = container.layers_total();
  size_t last_table = layers - 1;  // begins before this layer
  while (last_table > 0 && container.LayerBegin(last_table) == container.LayerEnd(last_table - 1)) {
    --last_table;
  }
  ASSERT_GT(last_table, 0u) << "all in one table";
  for (size_t layer = 0; layer < layers; ++layer) {
    // A layer may have no bytes, and is then there with the one before.
    if (layer + 1 < layers && container.LayerEnd(layer + 1) == container.LayerEnd(layer)) continue;
    WriteFile(folder.File("cut.folp"), Cut(SmallFile(), container.LayerEnd(layer)));
    const FileInfo info = ReadInfo(folder.File("cut.folp")).value();
    EXPECT_EQ(info.layers_present, layer + 1);
    EXPECT_EQ(info.layers_total, layers);
    EXPECT_GE(info.layers.size(), layer + 1);
    EXPECT_EQ(info.has_bits, layer >= last_table);
    EXPECT_EQ(info.tolerance.has_value(), layer >= last_table);
  }
}

TEST_P(CutFile, IsNeverLossless) {
  TemporaryFolder folder;
  auto runner = parallel::MakeSerialRunner();
  parallel::Progress progress;
  for (size_t missing : {size_t{1}, size_t{9}, SmallFile().size() / 2}) {
    WriteFile(folder.File("cut.folp"), Cut(SmallFile(), SmallFile().size() - missing));
    auto report = VerifyFile(folder.File("cut.folp"), "", {}, *runner, progress);
    if (!report.ok()) {
      EXPECT_EQ(report.error().kind, ErrorKind::kCorrupt);
      continue;
    }
    EXPECT_FALSE(report->lossless);
    EXPECT_FALSE(report->reason.empty());
  }
}

TEST_P(CutFile, RefusesBytesAfterItsEnd) {
  Bytes longer = SmallFile();
  longer.push_back(0);
  ErrorKind error;
  EXPECT_TRUE(DecodeLods(longer, &error).empty());
  EXPECT_EQ(error, ErrorKind::kCorrupt);
}

}  // namespace
}  // namespace folprom::hostile
