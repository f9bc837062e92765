#include "engine/partition/voxel_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "test_meshes.h"

namespace folprom::partition {
namespace {

TEST(VoxelGrid, FindsWhatWasInserted) {
  VoxelGrid grid;
  std::map<Int3, uint32_t> expected;
  TestRandom random(1);
  for (uint32_t i = 0; i < 20000; ++i) {
    const Int3 at{static_cast<int32_t>(random.Below(30)), static_cast<int32_t>(random.Below(30)),
                  static_cast<int32_t>(random.Below(1 << 20))};
    const uint32_t number = expected.try_emplace(at, i).first->second;
    ASSERT_EQ(grid.FindOrInsert(at, i), number);
  }
}

TEST(VoxelGrid, BricksDoNotOverlap) {
  std::set<Int3> origins;
  for (uint32_t i = 0; i < 40000; ++i) {
    const Int3 origin = VoxelGrid::BrickOrigin(i);
    EXPECT_EQ(origin.x % 8 + origin.y % 8 + origin.z % 8, 0);
    EXPECT_TRUE(origins.insert(origin).second) << i;
  }
}

TEST(VoxelGrid, TheLastBrickStaysInRange) {
  const Int3 origin = VoxelGrid::BrickOrigin((uint32_t{1} << 31) - 1);
  EXPECT_LT(std::max({origin.x, origin.y, origin.z}), 1 << 14);
}

}  // namespace
}  // namespace folprom::partition
