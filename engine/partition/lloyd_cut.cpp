#include "engine/partition/lloyd_cut.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace folprom::partition {
namespace {

constexpr int kIterations = 16;
constexpr double kStopBelow = 1e-3;  // part by which the distortion must still fall
constexpr int kPowerIterations = 12;
constexpr double kFill = 0.92;               // how full subtrees are on average
constexpr double kFullest = 0.97;            // how full cuts may aim to make one
constexpr double kSmallestPart = 1.0 / 8;    // of a full subtree
constexpr double kSmallestShare = 1.0 / 32;  // of the set

double Dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector Minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

void AddScaled(Vector* sum, double factor, const Vector& vector) {
  for (size_t axis = 0; axis < 3; ++axis) (*sum)[axis] += factor * vector[axis];
}

double Length(const Vector& vector) { return std::sqrt(Dot(vector, vector)); }

double WeightOf(const Site& site) { return static_cast<double>(site.weight); }

// base^exponent for base in [0, 1], exponent >= 0; std::pow differs between C libraries.
double Power(double base, double exponent) {
  double result = 1;
  for (; exponent >= 1; exponent -= 1) result *= base;
  double root = base;
  for (int bit = 0; bit < 30 && exponent > 0; ++bit) {
    root = std::sqrt(root);
    exponent *= 2;
    if (exponent >= 1) {
      result *= root;
      exponent -= 1;
    }
  }
  return result;
}

// Direction of the largest spread around `mean`; the x axis where there is none.
Vector MainAxis(std::span<const Site> sites, const Vector& mean) {
  std::array<Vector, 3> covariance{};
  for (const Site& site : sites) {
    const Vector offset = Minus(site.position, mean);
    for (size_t row = 0; row < 3; ++row) {
      AddScaled(&covariance[row], WeightOf(site) * offset[row], offset);
    }
  }
  // From the axis of the largest variance, which no main axis is at a right angle to by chance.
  size_t longest = 0;
  for (size_t row = 1; row < 3; ++row) {
    if (covariance[row][row] > covariance[longest][longest]) longest = row;
  }
  Vector axis{};
  axis[longest] = 1;
  for (int i = 0; i < kPowerIterations; ++i) {
    const Vector next =
        Normalised({Dot(covariance[0], axis), Dot(covariance[1], axis), Dot(covariance[2], axis)});
    if (Dot(next, next) == 0) break;
    axis = next;
  }
  return axis;
}

}  // namespace

Vector Normalised(const Vector& vector) {
  const double length = Length(vector);
  if (length == 0) return {};
  return {vector[0] / length, vector[1] / length, vector[2] / length};
}

uint32_t LloydCut::Subtrees(int64_t weight) const {
  const double full = static_cast<double>(settings_.subtree_vertices);
  return static_cast<uint32_t>(std::ceil(static_cast<double>(weight) / (kFill * full)));
}

LloydCut::Halves LloydCut::Halve(std::span<Site> sites, uint32_t subtrees) {
  MeasureSet(sites);
  const double natural = Iterate(sites);
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.nearness, a.along, a.index) < std::tie(b.nearness, b.along, b.index);
  });
  reordered_.clear();
  for (const Entry& entry : entries_) reordered_.push_back(sites[entry.index]);
  std::copy(reordered_.begin(), reordered_.end(), sites.begin());
  Halves halves;
  const double wanted = WantedWeight(natural, subtrees, &halves);
  halves.first_sites = PrefixOfWeight(sites, wanted);
  return halves;
}

void LloydCut::MeasureSet(std::span<const Site> sites) {
  total_ = 0;
  Vector sum{};
  for (const Site& site : sites) {
    total_ += WeightOf(site);
    AddScaled(&sum, WeightOf(site), site.position);
  }
  const Vector mean{sum[0] / total_, sum[1] / total_, sum[2] / total_};
  const Vector axis = MainAxis(sites, mean);
  entries_.clear();
  for (uint32_t i = 0; i < sites.size(); ++i) {
    const double along = Dot(Minus(sites[i].position, mean), axis);
    entries_.push_back({along, along, i});
  }
  normal_weight_ = settings_.normal_metric ? NormalWeight(sites) : 0;
}

double LloydCut::NormalWeight(std::span<const Site> sites) const {
  Vector sum{};
  for (const Site& site : sites) AddScaled(&sum, WeightOf(site), site.normal);
  const Vector mean_normal = Normalised(sum);
  double spread = 0;
  for (const Site& site : sites) {
    spread += WeightOf(site) * Length(Minus(site.normal, mean_normal));
  }
  const double alike = std::clamp(1 - spread / total_ / 2, 0.0, 1.0);
  return std::clamp(1 - settings_.metric_a * Power(alike, settings_.metric_b), 0.0, 1.0);
}

double LloydCut::Iterate(std::span<const Site> sites) {
  double distortion = 0;
  for (int i = 0; i < kIterations; ++i) {
    const double natural = UpdateCentres(sites);
    if (natural == 0 || natural == total_) {
      for (Entry& entry : entries_) entry.nearness = 0;
      return total_ / 2;
    }
    const double before = distortion;
    distortion = Assign(sites);
    if (i > 0 && before - distortion <= kStopBelow * before) break;
  }
  double natural = 0;
  for (const Entry& entry : entries_) {
    if (entry.nearness < 0) natural += WeightOf(sites[entry.index]);
  }
  return natural;
}

double LloydCut::UpdateCentres(std::span<const Site> sites) {
  std::array<double, 2> weight{};
  centres_ = {};
  for (const Entry& entry : entries_) {
    const Site& site = sites[entry.index];
    const size_t part = entry.nearness < 0 ? 0 : 1;
    weight[part] += WeightOf(site);
    AddScaled(&centres_[part].position, WeightOf(site), site.position);
    AddScaled(&centres_[part].normal, WeightOf(site), site.normal);
  }
  for (size_t part = 0; part < 2; ++part) {
    for (double& coordinate : centres_[part].position) coordinate /= weight[part];
    centres_[part].normal = Normalised(centres_[part].normal);
  }
  return weight[0];
}

double LloydCut::Assign(std::span<const Site> sites) {
  double distortion = 0;
  for (Entry& entry : entries_) {
    const Site& site = sites[entry.index];
    const double first = Distance(site, centres_[0]), second = Distance(site, centres_[1]);
    entry.nearness = first - second;
    distortion += WeightOf(site) * std::min(first, second);
  }
  return distortion;
}

double LloydCut::Distance(const Site& site, const Centre& centre) const {
  const double euclidean = Length(Minus(site.position, centre.position));
  if (normal_weight_ == 0) return euclidean;
  const double normal = Length(Minus(site.normal, centre.normal));
  return normal_weight_ * normal + (1 - normal_weight_) * euclidean;
}

double LloydCut::WantedWeight(double natural, uint32_t subtrees, Halves* halves) const {
  const double full = static_cast<double>(settings_.subtree_vertices);
  const double smallest =
      std::min(std::max(kSmallestPart * full, kSmallestShare * total_), total_ / 2);
  const double wanted = std::clamp(natural, smallest, total_ - smallest);
  const double all = std::max<double>(subtrees, 2);
  const double first = std::clamp(std::floor(wanted / total_ * all + 0.5), 1.0, all - 1);
  halves->first_subtrees = static_cast<uint32_t>(first);
  halves->second_subtrees = static_cast<uint32_t>(all - first);
  const double most = kFullest * full * first;
  const double least = total_ - kFullest * full * (all - first);
  if (least > most) return total_ * first / all;  // too full for such care
  return std::clamp(wanted, least, most);
}

size_t LloydCut::PrefixOfWeight(std::span<const Site> sites, double wanted) {
  double weight = WeightOf(sites[0]);
  size_t count = 1;
  while (count + 1 < sites.size() && weight + WeightOf(sites[count]) / 2 <= wanted) {
    weight += WeightOf(sites[count++]);
  }
  return count;
}

}  // namespace folprom::partition
