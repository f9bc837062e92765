#include "engine/partition/voxel_grid.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#include <openvdb/openvdb.h>
#pragma GCC diagnostic pop

namespace folprom::partition {

struct VoxelGrid::Impl {
  static constexpr int32_t kNone = -1;
  openvdb::Int32Grid::Ptr grid = openvdb::Int32Grid::create(kNone);
  openvdb::Int32Grid::Accessor accessor = grid->getAccessor();

  // Node by node: the tree's own destructor would start threads of its own to free the nodes.
  ~Impl() {
    accessor.clear();
    grid->tree().root().clear();
  }
};

VoxelGrid::VoxelGrid() : impl_(std::make_unique<Impl>()) {}
VoxelGrid::~VoxelGrid() = default;

uint32_t VoxelGrid::FindOrInsert(const Int3& coordinate, uint32_t next) {
  const openvdb::Coord at(coordinate.x, coordinate.y, coordinate.z);
  const int32_t found = impl_->accessor.getValue(at);
  if (found != Impl::kNone) return static_cast<uint32_t>(found);
  impl_->accessor.setValue(at, static_cast<int32_t>(next));
  return next;
}

Int3 VoxelGrid::BrickOrigin(uint32_t index) {
  // 16 x 16 x 16 bricks share one inner node of the tree; fill it before the next one.
  const uint32_t node = index >> 12;
  const uint32_t x = (index & 15) + 16 * (node & 127);
  const uint32_t y = (index >> 4 & 15) + 16 * (node >> 7 & 127);
  const uint32_t z = (index >> 8 & 15) + 16 * (node >> 14);
  return {static_cast<int32_t>(8 * x), static_cast<int32_t>(8 * y), static_cast<int32_t>(8 * z)};
}

}  // namespace folprom::partition
