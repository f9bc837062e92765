#include "engine/partition/subtree_groups.h"

#include <gtest/gtest.h>

#include <map>

#include "test_meshes.h"

namespace folprom::partition {
namespace {

TEST(SubtreeGroups, SortsBySubtreeAndKeepsTheOrderInside) {
  SubtreeGroups<int> groups;
  TestRandom random(3);
  for (const size_t count : {size_t{1000}, size_t{0}, size_t{10}, size_t{5000}}) {
    groups.Start(40, count);
    std::map<uint32_t, std::vector<int>> expected;
    for (size_t i = 0; i < count; ++i) {
      const auto subtree = static_cast<uint32_t>(random.Below(40));
      const auto item = static_cast<int>(i);
      EXPECT_EQ(groups.Add(subtree, item), expected[subtree].size());
      expected[subtree].push_back(item);
    }
    groups.Sort();
    ASSERT_EQ(groups.subtrees().size(), expected.size());
    for (uint32_t subtree : groups.subtrees()) {
      const auto items = groups.Items(subtree);
      EXPECT_EQ(std::vector<int>(items.begin(), items.end()), expected.at(subtree));
    }
  }
}

}  // namespace
}  // namespace folprom::partition
