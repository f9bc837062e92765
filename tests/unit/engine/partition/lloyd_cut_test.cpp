#include "engine/partition/lloyd_cut.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "test_meshes.h"

namespace folprom::partition {
namespace {

int64_t WeightOf(std::span<const Site> sites) {
  int64_t sum = 0;
  for (const Site& site : sites) sum += site.weight;
  return sum;
}

Site SiteAt(Vector position, Vector normal, int64_t weight = 1) {
  Site site;
  site.position = position;
  site.normal = normal;
  site.weight = weight;
  return site;
}

PartitionSettings Settings(uint32_t subtree_vertices) {
  PartitionSettings settings;
  settings.subtree_vertices = subtree_vertices;
  return settings;
}

TEST(LloydCut, FindsTwoClusters) {
  TestRandom random(4);
  std::vector<Site> sites;
  for (int i = 0; i < 100; ++i) {
    const double shift = i % 2 == 0 ? 0 : 3000;
    sites.push_back(SiteAt({shift + random.Next(), random.Next(), random.Next()}, {0, 0, 1}));
  }
  const auto halves = LloydCut(Settings(60)).Halve(sites, 2);
  ASSERT_EQ(halves.first_sites, 50u);
  for (size_t i = 0; i < 100; ++i) EXPECT_EQ(sites[i].position[0] < 1000, i < 50);
}

// Two flat strips that meet at a right angle: 40 sites on one, 60 on the other.
std::vector<Site> Crease() {
  std::vector<Site> sites;
  for (int i = 0; i < 40; ++i) sites.push_back(SiteAt({i * 0.1 - 4, 0, 0}, {0, 0, 1}));
  for (int i = 0; i < 60; ++i) sites.push_back(SiteAt({0, 0, -i * 0.1}, {1, 0, 0}));
  return sites;
}

bool IsCutAtTheCrease(const PartitionSettings& settings) {
  std::vector<Site> sites = Crease();
  const size_t first = LloydCut(settings).Halve(sites, 2).first_sites;
  const auto alike = [](const Site& a, const Site& b) { return a.normal == b.normal; };
  return std::equal(sites.begin() + 1, sites.begin() + static_cast<ptrdiff_t>(first), sites.begin(),
                    alike) &&
         std::equal(sites.begin() + static_cast<ptrdiff_t>(first) + 1, sites.end(),
                    sites.begin() + static_cast<ptrdiff_t>(first), alike);
}

TEST(LloydCut, FollowsAnEdgeOfTheSurface) { EXPECT_TRUE(IsCutAtTheCrease(Settings(80))); }

TEST(LloydCut, FollowsNoEdgeWithTheEuclideanMetric) {
  PartitionSettings settings = Settings(80);
  settings.normal_metric = false;
  EXPECT_FALSE(IsCutAtTheCrease(settings));
}

TEST(LloydCut, CutsAlikeSitesInHalf) {
  std::vector<Site> sites(64, SiteAt({5, 5, 5}, {1, 0, 0}, 3));
  EXPECT_EQ(LloydCut(Settings(100)).Halve(sites, 2).first_sites, 32u);
}

TEST(LloydCut, NeverLeavesAPartEmpty) {
  TestRandom random(6);
  for (int round = 0; round < 300; ++round) {
    std::vector<Site> sites;
    const size_t count = 2 + random.Below(20);
    for (size_t i = 0; i < count; ++i) {
      const double x = static_cast<double>(random.Below(3));
      sites.push_back(SiteAt({x * 1000, static_cast<double>(random.Below(2)), 0}, {0, 0, 0},
                             static_cast<int64_t>(1 + random.Below(4))));
    }
    PartitionSettings settings = Settings(static_cast<uint32_t>(WeightOf(sites) - 1));
    settings.metric_a = 0.25 * static_cast<double>(random.Below(5));
    const auto halves = LloydCut(settings).Halve(sites, static_cast<uint32_t>(1 + random.Below(4)));
    EXPECT_GE(halves.first_sites, 1u);
    EXPECT_LT(halves.first_sites, count);
    EXPECT_GE(halves.first_subtrees, 1u);
    EXPECT_GE(halves.second_subtrees, 1u);
  }
}

TEST(LloydCut, LeavesNoSliver) {
  std::vector<Site> sites;
  for (int i = 0; i < 200; ++i) sites.push_back(SiteAt({i * 0.01, 0, 0}, {0, 0, 1}));
  sites.push_back(SiteAt({4000, 0, 0}, {0, 0, 1}));
  const size_t first = LloydCut(Settings(160)).Halve(sites, 2).first_sites;
  EXPECT_GE(std::min(first, sites.size() - first), 160u / 8);
}

TEST(LloydCut, DoesNotChangeTheSites) {
  TestRandom random(8);
  std::vector<Site> sites;
  for (uint32_t i = 0; i < 500; ++i) {
    sites.push_back(SiteAt({4096 * random.Next(), 4096 * random.Next(), 0}, {0, 0, 1}));
    sites.back().voxel = i;
  }
  const std::vector<Site> before = sites;
  LloydCut(Settings(300)).Halve(sites, 2);
  std::sort(sites.begin(), sites.end(),
            [](const Site& a, const Site& b) { return a.voxel < b.voxel; });
  for (size_t i = 0; i < sites.size(); ++i) {
    EXPECT_EQ(sites[i].voxel, i);
    EXPECT_EQ(sites[i].position, before[i].position);
  }
}

}  // namespace
}  // namespace folprom::partition
