// One step of the split: a set of weighted sites into two, by Lloyd's iteration.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/partition/partition.h"

namespace folprom::partition {

using Vector = std::array<double, 3>;

/// The vector at length 1; zero stays zero.
Vector Normalised(const Vector& vector);

/// A voxel as the split sees it.
struct Site {
  Vector position{};   ///< mean of the vertices, in units of the metric
  Vector normal{};     ///< unit, or zero where there is none
  int64_t weight = 0;  ///< vertices, at least 1
  uint32_t voxel = 0;
};

/// Runs on one thread, with + - * / sqrt only, so the result is the same on every machine.
class LloydCut {
 public:
  explicit LloydCut(const PartitionSettings& settings) : settings_(settings) {}

  /// A good number of subtrees for a set of this weight.
  uint32_t Subtrees(int64_t weight) const;

  struct Halves {
    size_t first_sites = 0;       ///< at least one, not all
    uint32_t first_subtrees = 0;  ///< of the subtrees asked for; at least one
    uint32_t second_subtrees = 0;
  };
  /// Reorders `sites` (at least two, together heavier than subtree_vertices) so that the first part
  /// comes first. Follows the cells of the two centres, unless that would leave a sliver or end in
  /// more than `subtrees` subtrees.
  Halves Halve(std::span<Site> sites, uint32_t subtrees);

 private:
  struct Centre {
    Vector position{};
    Vector normal{};
  };
  struct Entry {
    double nearness;  // distance to the first centre less that to the second
    double along;     // place on the main axis
    uint32_t index;
  };

  void MeasureSet(std::span<const Site> sites);
  double NormalWeight(std::span<const Site> sites) const;
  /// Sets every entry's nearness. Returns the weight of those nearer to the first centre.
  double Iterate(std::span<const Site> sites);
  /// Centres of the two parts by the sign of nearness. Returns the weight of the first part.
  double UpdateCentres(std::span<const Site> sites);
  /// Returns the distortion.
  double Assign(std::span<const Site> sites);
  double Distance(const Site& site, const Centre& centre) const;
  /// Weight that the first part should have when the centres give it `natural`, and its subtrees.
  double WantedWeight(double natural, uint32_t subtrees, Halves* halves) const;
  /// How many leading sites come nearest to the weight; at least one, not all.
  static size_t PrefixOfWeight(std::span<const Site> sites, double wanted);

  const PartitionSettings settings_;
  double total_ = 0;          // weight of the set
  double normal_weight_ = 0;  // w_n
  std::array<Centre, 2> centres_;
  std::vector<Entry> entries_;
  std::vector<Site> reordered_;
};

}  // namespace folprom::partition
