#include "engine/partition/voxel_split.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "engine/partition/lloyd_cut.h"

namespace folprom::partition {
namespace {

// The paper's constants hold for a model whose longest side is this long.
constexpr double kMetricSide = 4096;

std::array<double, 3> Direction(const NormalSum& sum) {
  const std::array<double, 3> vector{static_cast<double>(sum[0]), static_cast<double>(sum[1]),
                                     static_cast<double>(sum[2])};
  return Normalised(vector);
}

// All voxels with vertices, in an order that depends on their places only.
std::vector<Site> Sites(std::span<const Voxel> voxels, std::span<const NormalSum> normals,
                        const Lattice& lattice) {
  std::vector<uint32_t> order;
  for (uint32_t i = 0; i < voxels.size(); ++i) {
    if (voxels[i].count > 0) order.push_back(i);
  }
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return std::tie(voxels[a].lo, a) < std::tie(voxels[b].lo, b);
  });
  const int32_t longest = *std::max_element(lattice.extent.begin(), lattice.extent.end());
  const double scale = longest > 0 ? kMetricSide / longest : 0;
  std::vector<Site> sites;
  sites.reserve(order.size());
  for (uint32_t i : order) {
    const Voxel& voxel = voxels[i];
    Site site;
    site.voxel = i;
    site.weight = voxel.count;
    for (size_t axis = 0; axis < 3; ++axis) {
      site.position[axis] =
          static_cast<double>(voxel.sum[axis]) / static_cast<double>(voxel.count) * scale;
    }
    if (!normals.empty()) site.normal = Direction(normals[i]);
    sites.push_back(site);
  }
  return sites;
}

void Extend(SubtreeSummary* part, const Voxel& voxel) {
  if (part->vertices == 0) {
    part->box_lo = voxel.lo;
    part->box_hi = voxel.hi;
  }
  part->vertices += static_cast<uint32_t>(voxel.count);
  Int3 &lo = part->box_lo, &hi = part->box_hi;
  lo = {std::min(lo.x, voxel.lo.x), std::min(lo.y, voxel.lo.y), std::min(lo.z, voxel.lo.z)};
  hi = {std::max(hi.x, voxel.hi.x), std::max(hi.y, voxel.hi.y), std::max(hi.z, voxel.hi.z)};
}

int64_t Weight(std::span<const Site> sites) {
  int64_t sum = 0;
  for (const Site& site : sites) sum += site.weight;
  return sum;
}

struct OpenSet {
  std::span<Site> sites;
  uint32_t subtrees;  // to end in
};

}  // namespace

VoxelSplit SplitVoxels(std::span<const Voxel> voxels, std::span<const NormalSum> normals,
                       const Lattice& lattice, const PartitionSettings& settings) {
  VoxelSplit split;
  split.subtree.assign(voxels.size(), 0);
  std::vector<Site> sites = Sites(voxels, normals, lattice);
  LloydCut cut(settings);
  std::vector<OpenSet> open;  // the next in depth-first order last
  if (!sites.empty()) open.push_back({sites, cut.Subtrees(Weight(sites))});
  while (!open.empty()) {
    const auto [set, subtrees] = open.back();
    open.pop_back();
    if (Weight(set) > settings.subtree_vertices) {
      const LloydCut::Halves halves = cut.Halve(set, subtrees);
      open.push_back({set.subspan(halves.first_sites), halves.second_subtrees});
      open.push_back({set.first(halves.first_sites), halves.first_subtrees});
      continue;
    }
    for (const Site& site : set) {
      split.subtree[site.voxel] = static_cast<uint32_t>(split.subtrees.size());
    }
    SubtreeSummary& part = split.subtrees.emplace_back();
    for (const Site& site : set) Extend(&part, voxels[site.voxel]);
  }
  return split;
}

}  // namespace folprom::partition
