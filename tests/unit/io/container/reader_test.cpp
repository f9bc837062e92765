#include "io/container/reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <thread>

#include "io/container/byte_code.h"
#include "io/container/checksum.h"
#include "io/container/header.h"
#include "io/container/layout.h"
#include "samples.h"

namespace folprom::io {
namespace {

void ExpectOpenFails(std::span<const uint8_t> bytes, ErrorKind kind, const std::string& reason) {
  const auto reader = ContainerReader::Open(bytes, "scan.folp");
  ASSERT_FALSE(reader.ok()) << bytes.size();
  EXPECT_EQ(reader.error().kind, kind) << reader.error().message;
  EXPECT_TRUE(reader.error().message.starts_with("scan.folp: ")) << reader.error().message;
  EXPECT_NE(reader.error().message.find(reason), std::string::npos) << reader.error().message;
}

/// Whether the segment comes back right; a failure must be kCorrupt.
bool ComesBack(const ContainerReader& reader, size_t layer, size_t subtree, SegmentPart part) {
  const auto segment = reader.Segment(layer, subtree, part);
  if (!segment.ok()) {
    EXPECT_EQ(segment.error().kind, ErrorKind::kCorrupt);
    EXPECT_TRUE(segment.error().message.starts_with("scan.folp: layer "));
    return false;
  }
  const auto bytes = Result(segment).value();
  const auto expected = SampleSegment(reader.table(), layer, subtree, part);
  EXPECT_TRUE(std::equal(bytes.begin(), bytes.end(), expected.begin(), expected.end()));
  return true;
}

TEST(ContainerReader, BringsBackTableAndSegments) {
  for (uint64_t seed = 0; seed < 100; ++seed) {
    const FileTable table = RandomTable(seed, true);
    const auto file = SampleFile(table);
    auto reader = ContainerReader::Open(file, "scan.folp");
    ASSERT_TRUE(reader.ok()) << reader.error().message;
    EXPECT_EQ(reader->table(), table);
    EXPECT_EQ(reader->complete_layers(), table.layers.size());
    EXPECT_EQ(reader->file_bytes(), file.size());
    ForEachSegment(table, [&](size_t layer, size_t subtree, SegmentPart part) {
      EXPECT_TRUE(ComesBack(*reader, layer, subtree, part));
    });
  }
}

TEST(ContainerReader, AccountsForEveryByte) {
  const FileTable table = ScanLikeTable();
  const auto file = SampleFile(table);
  auto reader = ContainerReader::Open(file, "scan.folp");
  uint64_t segments = 0;
  for (const uint64_t bytes : table.segment_bytes) segments += bytes;
  EXPECT_EQ(reader->table_bytes() + reader->checksum_bytes() + segments, file.size());
  RecordProperty("table_bytes", static_cast<int>(reader->table_bytes()));
  RecordProperty("checksum_bytes", static_cast<int>(reader->checksum_bytes()));
  RecordProperty("file_bytes", static_cast<int>(file.size()));
  EXPECT_LT((reader->table_bytes() + reader->checksum_bytes()) * 1000, file.size() * 4);
  for (size_t layer = 1; layer < table.layers.size(); ++layer) {
    EXPECT_GE(reader->LayerEnd(layer), reader->LayerEnd(layer - 1));
  }
  EXPECT_EQ(reader->LayerEnd(table.layers.size() - 1), file.size());
}

/// Three layers in three tables.
FileTable TableInParts() {
  FileTable table = ExampleTable();
  table.layers = {{4, 100, 196}, {2, 300, 596}, {1, 700, 1396}};
  table.segment_bytes = {300, 0, 18, 3, 600, 0, 500, 7, 900, 1, 1000, 2};
  return table;
}

TEST(ContainerReader, ReadsTablesBetweenLayersAtEveryTruncation) {
  const FileTable table = TableInParts();
  const auto file = SampleFile(table);
  auto whole = ContainerReader::Open(file, "scan.folp");
  EXPECT_EQ(whole->table(), table);
  EXPECT_GT(whole->LayerBegin(1), whole->LayerEnd(0));
  EXPECT_GT(whole->LayerBegin(2), whole->LayerEnd(1));
  for (size_t size = whole->header_bytes(); size < file.size(); ++size) {
    auto reader = ContainerReader::Open(std::span(file).first(size), "scan.folp");
    ASSERT_TRUE(reader.ok()) << reader.error().message;
    EXPECT_EQ(reader->layers_total(), 3u);
    size_t complete = 0, known = 1;
    while (complete < 3 && whole->LayerEnd(complete) <= size) ++complete;
    while (known < 3 && whole->LayerBegin(known) <= size) ++known;
    EXPECT_EQ(reader->complete_layers(), complete);
    EXPECT_EQ(reader->table().layers.size(), known);
    EXPECT_EQ(reader->has_all_tables(), known == 3);
    ForEachSegment(table, [&](size_t layer, size_t subtree, SegmentPart part) {
      EXPECT_TRUE(ComesBack(*reader, layer, subtree, part) || layer >= complete);
    });
  }
}

TEST(ContainerReader, FindsEveryFlippedBitOfATableBetweenLayers) {
  auto file = SampleFile(TableInParts());
  auto whole = ContainerReader::Open(file, "scan.folp");
  for (size_t layer : {1u, 2u}) {
    for (uint64_t byte = whole->LayerEnd(layer - 1); byte < whole->LayerBegin(layer); ++byte) {
      for (int bit = 0; bit < 8; ++bit) {
        file[byte] = static_cast<uint8_t>(file[byte] ^ 1u << bit);
        ExpectOpenFails(file, ErrorKind::kCorrupt, "checksum of the table (bytes");
        file[byte] = static_cast<uint8_t>(file[byte] ^ 1u << bit);
      }
    }
  }
}

TEST(ContainerReader, EveryTruncationGivesTheLayersThatAreWhole) {
  const FileTable table = ExampleTable();
  const auto file = SampleFile(table);
  auto whole = ContainerReader::Open(file, "scan.folp");
  for (size_t size = 0; size < file.size(); ++size) {
    const auto cut = std::span(file).first(size);
    if (size < whole->header_bytes()) {
      ExpectOpenFails(cut, ErrorKind::kCorrupt, "cut inside the header: " + std::to_string(size));
      continue;
    }
    auto reader = ContainerReader::Open(cut, "scan.folp");
    ASSERT_TRUE(reader.ok()) << reader.error().message;
    size_t complete = 0;
    while (complete < table.layers.size() && whole->LayerEnd(complete) <= size) ++complete;
    EXPECT_EQ(reader->complete_layers(), complete);
    bool all_later = true;
    ForEachSegment(table, [&](size_t layer, size_t subtree, SegmentPart part) {
      const bool there = ComesBack(*reader, layer, subtree, part);
      EXPECT_TRUE(there || layer >= complete);
      all_later = all_later && (there || layer < complete);
    });
    EXPECT_FALSE(all_later);
  }
}

TEST(ContainerReader, EveryFlippedBitIsFound) {
  const FileTable table = ExampleTable();
  auto file = SampleFile(table);
  for (size_t bit = 0; bit < file.size() * 8; ++bit) {
    const auto mask = static_cast<uint8_t>(1u << bit % 8);
    file[bit / 8] = static_cast<uint8_t>(file[bit / 8] ^ mask);
    auto reader = ContainerReader::Open(file, "scan.folp");
    if (reader.ok()) {
      EXPECT_GE(bit / 8, reader->header_bytes());
      bool all = true;
      ForEachSegment(table, [&](size_t layer, size_t subtree, SegmentPart part) {
        all = ComesBack(*reader, layer, subtree, part) && all;
      });
      EXPECT_FALSE(all) << "bit " << bit;
    }
    file[bit / 8] = static_cast<uint8_t>(file[bit / 8] ^ mask);
  }
}

TEST(ContainerReader, DamageStaysInsideItsGroup) {
  FileTable table = ExampleTable();
  const uint64_t group = table.segment_bytes[4] = GroupBytes(table.subtrees.size());
  auto file = SampleFile(table);
  const uint64_t first_of_layer_1 = ContainerReader::Open(file, "f")->LayerEnd(0);
  file[first_of_layer_1] ^= 1;
  auto reader = ContainerReader::Open(file, "scan.folp");
  EXPECT_EQ(reader->complete_layers(), 2u);
  EXPECT_FALSE(ComesBack(*reader, 1, 0, SegmentPart::kInner));
  EXPECT_TRUE(ComesBack(*reader, 1, 1, SegmentPart::kInner));
  EXPECT_TRUE(ComesBack(*reader, 0, 0, SegmentPart::kInner));
  const auto error = reader->Segment(1, 0, SegmentPart::kInner).error();
  EXPECT_EQ(error.message, "scan.folp: layer 1, subtree 0, inner segment: checksum of bytes " +
                               std::to_string(first_of_layer_1) + " to " +
                               std::to_string(first_of_layer_1 + group) + " differs");
}

TEST(ContainerReader, RejectsExtraBytes) {
  auto file = SampleFile(ExampleTable());
  const std::string end = std::to_string(file.size());
  file.push_back(0);
  ExpectOpenFails(file, ErrorKind::kCorrupt, "1 bytes after the end at byte " + end);
  file.resize(file.size() + 99);
  ExpectOpenFails(file, ErrorKind::kCorrupt, "100 bytes after the end");
}

TEST(ContainerReader, TellsOtherFilesFromDamagedOnes) {
  const std::string ply = "ply\nformat binary";
  ExpectOpenFails(std::span(reinterpret_cast<const uint8_t*>(ply.data()), ply.size()),
                  ErrorKind::kInput, "not a .folp file");
  ExpectOpenFails({}, ErrorKind::kCorrupt, "0 of at least 22 bytes");
  auto text_mode = SampleFile(ExampleTable());
  text_mode.erase(text_mode.begin() + 5);  // CR LF -> LF
  ExpectOpenFails(text_mode, ErrorKind::kInput, "not a .folp file");
}

TEST(ContainerReader, RejectsUnknownVersions) {
  auto file = SampleFile(ExampleTable());
  file[8] = 0x2c;
  file[9] = 0x01;
  ExpectOpenFails(file, ErrorKind::kInput, "format version 300, this program reads up to 1");
  ExpectOpenFails(std::span(file).first(10), ErrorKind::kInput, "format version 300");
  ExpectOpenFails(std::span(file).first(9), ErrorKind::kCorrupt, "9 of at least 22 bytes");
}

TEST(ContainerReader, RejectsATableLongerThanTheFile) {
  auto file = SampleFile(ExampleTable());
  std::fill_n(file.begin() + 10, 4, uint8_t{0xff});
  ExpectOpenFails(file, ErrorKind::kCorrupt, "of 4294967317 bytes");
}

TEST(ContainerReader, RejectsAHostileTableWithAGoodChecksum) {
  const auto table = std::vector<uint8_t>(200, 0x7f);
  std::vector<uint8_t> file(kMagic.begin(), kMagic.end());
  AppendLittleEndian(uint16_t{kFormatVersion}, &file);
  AppendLittleEndian(static_cast<uint32_t>(table.size()), &file);
  file.insert(file.end(), table.begin(), table.end());
  AppendLittleEndian(XxHash64(file), &file);
  ExpectOpenFails(file, ErrorKind::kCorrupt, "");
}

TEST(ContainerReader, SeveralThreadsMayReadTheSameGroup) {
  const FileTable table = ScanLikeTable();
  const auto file = SampleFile(table);
  auto reader = ContainerReader::Open(file, "scan.folp");
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i) {
    threads.emplace_back([&] {
      ForEachSegment(table, [&](size_t layer, size_t subtree, SegmentPart part) {
        EXPECT_TRUE(ComesBack(*reader, layer, subtree, part));
      });
    });
  }
  for (std::thread& thread : threads) thread.join();
}

TEST(ContainerReader, RefusesSegmentsThatDoNotExist) {
  const auto file = SampleFile(ExampleTable());
  auto reader = ContainerReader::Open(file, "scan.folp");
  EXPECT_EQ(reader->Segment(2, 0, SegmentPart::kInner).error().kind, ErrorKind::kInternal);
  EXPECT_EQ(reader->Segment(0, 2, SegmentPart::kSeam).error().kind, ErrorKind::kInternal);
}

}  // namespace
}  // namespace folprom::io
