// The paper's Lloyd split (section 2.1) on voxels that stand for their vertices.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/partition/partition.h"
#include "engine/partition/voxel_normals.h"
#include "engine/partition/voxel_statistics.h"

namespace folprom::partition {

struct VoxelSplit {
  std::vector<uint32_t> subtree;         ///< per voxel; of no meaning for voxels without vertices
  std::vector<SubtreeSummary> subtrees;  ///< box and vertex count of each
};

/// Halves the set of voxels until each part holds at most settings.subtree_vertices vertices. Parts
/// are numbered depth first. A voxel may hold at most subtree_vertices. `normals` is either one per
/// voxel or empty. The numbers of the voxels do not matter, except between voxels of equal `lo`.
VoxelSplit SplitVoxels(std::span<const Voxel> voxels, std::span<const NormalSum> normals,
                       const Lattice& lattice, const PartitionSettings& settings);

}  // namespace folprom::partition
