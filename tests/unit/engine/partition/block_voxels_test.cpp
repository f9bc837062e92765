#include "engine/partition/block_voxels.h"

#include <gtest/gtest.h>

#include <map>

#include "test_meshes.h"

namespace folprom::partition {
namespace {

TEST(BlockVoxels, CountsEveryVertexInItsVoxel) {
  BlockVoxels voxels;
  TestRandom random(2);
  for (int block = 0; block < 3; ++block) {
    voxels.Clear();
    std::map<Int3, Voxel> expected;
    for (int i = 0; i < 30000; ++i) {
      const Int3 position{static_cast<int32_t>(random.Below(300)),
                          static_cast<int32_t>(random.Below(300)),
                          static_cast<int32_t>(random.Below(300))};
      const Int3 coordinate{position.x / 16, position.y / 16, position.z / 16};
      expected[coordinate].Add(position);
      const uint32_t number = voxels.Add(coordinate, position);
      EXPECT_EQ(voxels.entries()[number].coordinate, coordinate);
    }
    ASSERT_EQ(voxels.entries().size(), expected.size());
    for (const auto& [coordinate, voxel] : voxels.entries()) {
      const Voxel& wanted = expected.at(coordinate);
      EXPECT_EQ(voxel.count, wanted.count);
      EXPECT_EQ(voxel.sum, wanted.sum);
      EXPECT_EQ(voxel.lo, wanted.lo);
      EXPECT_EQ(voxel.hi, wanted.hi);
    }
  }
}

TEST(BlockVoxels, KeepsTheLargestCoordinatesApart) {
  BlockVoxels voxels;
  voxels.Clear();
  const int32_t last = (1 << 21) - 1;
  EXPECT_EQ(voxels.Add({last, last, last}, {1, 1, 1}), 0u);
  EXPECT_EQ(voxels.Add({last, last, last - 1}, {1, 1, 1}), 1u);
  EXPECT_EQ(voxels.Add({last - 1, last, last}, {1, 1, 1}), 2u);
  EXPECT_EQ(voxels.Add({last, last, last}, {1, 1, 1}), 0u);
}

TEST(Voxel, JoinedIsTheSameAsCountedTogether) {
  Voxel left, right, all;
  for (const Int3& position : {Int3{1, 5, 9}, Int3{-4, 2, 9}}) {
    left.Add(position);
    all.Add(position);
  }
  right.Add(Int3{7, 7, 7});
  all.Add(Int3{7, 7, 7});
  left.Add(right);
  EXPECT_EQ(left.count, all.count);
  EXPECT_EQ(left.sum, all.sum);
  EXPECT_EQ(left.lo, all.lo);
  EXPECT_EQ(left.hi, all.hi);
  left.Add(Voxel{});
  EXPECT_EQ(left.lo, all.lo);
}

}  // namespace
}  // namespace folprom::partition
