#include "io/container/layout.h"

#include <gtest/gtest.h>

namespace folprom::io {
namespace {

/// Layers of two subtrees: sizes inner 0, seam 0, inner 1, seam 1, layer by layer.
FileTable TableOf(std::vector<uint64_t> sizes) {
  FileTable table;
  table.subtrees.resize(2);
  table.layers.resize(sizes.size() / 4);
  table.segment_bytes = std::move(sizes);
  return table;
}

FileLayout LayoutOf(const FileTable& table, uint64_t header_bytes) {
  FileLayout layout(header_bytes);
  layout.AddLayers(table, table.layers.size());
  return layout;
}

using Ends = std::vector<std::pair<uint64_t, uint64_t>>;
Ends GroupsOf(const FileLayout& layout) {
  Ends groups;
  for (const ChecksumGroup& group : layout.groups()) groups.emplace_back(group.begin, group.end);
  return groups;
}

TEST(Layout, JoinsSegmentsUntilAGroupHasItsBytes) {
  const FileLayout layout = LayoutOf(TableOf({16383, 1, 16384, 0}), 100);
  EXPECT_EQ(GroupsOf(layout), (Ends{{100, 16484}, {16488, 32872}}));
  EXPECT_EQ(layout.segment_begin(), (std::vector<uint64_t>{100, 16483, 16488, 32876}));
  EXPECT_EQ(layout.end(), 32876u);
  EXPECT_EQ(layout.checksum_bytes(), 8u);
}

TEST(Layout, GroupsOfManySubtreesAreSmall) {
  EXPECT_EQ(GroupBytes(1), 32768u);
  EXPECT_EQ(GroupBytes(10), 3276u);
  EXPECT_EQ(GroupBytes(64), 512u);
  EXPECT_EQ(GroupBytes(100000), 512u);
}

TEST(Layout, TheRestOfALayerIsItsOwnGroup) {
  const FileLayout layout = LayoutOf(TableOf({20000, 5, 0, 6, 7, 0, 0, 0}), 0);
  EXPECT_EQ(GroupsOf(layout), (Ends{{0, 20000}, {20004, 20015}, {20019, 20026}}));
  EXPECT_EQ(layout.layer_end(), (std::vector<uint64_t>{20019, 20030}));
}

TEST(Layout, ALayerWithoutBytesHasNoChecksum) {
  const FileLayout layout = LayoutOf(TableOf({0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}), 50);
  EXPECT_EQ(GroupsOf(layout), (Ends{{50, 51}}));
  EXPECT_EQ(layout.layer_end(), (std::vector<uint64_t>{50, 55, 55}));
}

TEST(Layout, AGroupNeverCrossesALayer) {
  const FileLayout layout = LayoutOf(TableOf({1, 1, 1, 1, 1, 1, 1, 1}), 0);
  EXPECT_EQ(GroupsOf(layout), (Ends{{0, 4}, {8, 12}}));
}

TEST(Layout, ATableBetweenLayersIsNoPartOfThem) {
  FileTable table = TableOf({10, 0, 0, 0});
  FileLayout layout = LayoutOf(table, 100);
  layout.AddTable(30);
  table = TableOf({10, 0, 0, 0, 20, 0, 0, 0});
  layout.AddLayers(table, table.layers.size());
  EXPECT_EQ(GroupsOf(layout), (Ends{{100, 110}, {148, 168}}));
  EXPECT_EQ(layout.layer_begin(), (std::vector<uint64_t>{100, 148}));
  EXPECT_EQ(layout.layer_end(), (std::vector<uint64_t>{114, 172}));
  EXPECT_EQ(layout.table_bytes(), 134u);
  EXPECT_EQ(layout.end(), 172u);
}

TEST(Layout, WithoutLayersTheFileEndsAfterTheHeader) {
  const FileLayout layout = LayoutOf(FileTable{}, 77);
  EXPECT_EQ(layout.end(), 77u);
  EXPECT_TRUE(layout.groups().empty());
}

}  // namespace
}  // namespace folprom::io
