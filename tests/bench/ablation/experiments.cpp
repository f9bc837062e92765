#include "tests/bench/ablation/experiments.h"

namespace folprom::bench {
namespace {

double OwnBits(uint64_t cost) { return static_cast<double>(cost) / 1024; }

BitExperiment::Bits PerValue(uint64_t cost, const ValueTally& tally) {
  const double values = static_cast<double>(tally.values());
  return {OwnBits(cost) / values, tally.EntropyBits() / values};
}

BitExperiment::Bits PerVertex(const Costs& costs, uint64_t cost, double plain) {
  const double vertices = static_cast<double>(costs.vertices);
  return {OwnBits(cost) / vertices, plain / vertices};
}

double PlainOffsets(const Costs& costs) {
  return costs.offsets.theta.EntropyBits() + costs.offsets.rho.EntropyBits() +
         costs.offsets.z.EntropyBits();
}

void EuclideanCentres(CodecSettings& s) {
  s.normal_metric = s.subtree_normals = false;
  s.representative = Representative::kCentre;
}
void Cartesian(CodecSettings& s) { s.offsets = Offsets::kCartesian; }

}  // namespace

const std::vector<RateExperiment>& RateExperiments() {
  static const std::vector<RateExperiment> experiments = {
      {"adaptive hierarchy control", "lower curve (figure 1)", "mean", EuclideanCentres,
       &Curve::Point::mean},
      {"of it normals in the metric", "lower curve", "mean",
       [](CodecSettings& s) { s.normal_metric = s.subtree_normals = false; }, &Curve::Point::mean},
      {"of it curved representatives", "lower curve", "mean",
       [](CodecSettings& s) { s.representative = Representative::kCentre; }, &Curve::Point::mean},
      {"adaptive quantisation", "more than a third lower", "rms",
       [](CodecSettings& s) { s.adaptive_quantisation = false; }, &Curve::Point::rms},
      {"the same, off with Q = 64", "lower", "rms",
       [](CodecSettings& s) {
         s.adaptive_quantisation = false;
         s.quantisation_levels = 64;
       },
       &Curve::Point::rms},
      {"cylindrical, not Cartesian offsets", "lower", "mean", Cartesian, &Curve::Point::mean},
  };
  return experiments;
}

const std::vector<BitExperiment>& BitExperiments() {
  static const std::vector<BitExperiment> experiments = {
      {"prediction of theta", "fewer", "bits a theta",
       [](CodecSettings& s) { s.predict_theta = false; },
       [](const Costs& c) { return PerValue(c.meters.offsets.theta, c.offsets.theta); }},
      {"prediction of z", "fewer", "bits a z", [](CodecSettings& s) { s.predict_height = false; },
       [](const Costs& c) { return PerValue(c.meters.offsets.z, c.offsets.z); }},
      {"pivot ordering", "half", "pivot bits a vertex",
       [](CodecSettings& s) { s.pivot_order = false; },
       [](const Costs& c) {
         return PerVertex(c, c.meters.connectivity.pivots, c.flags.pivots.EntropyBits());
       }},
      {"nearer child", "70 % fewer", "side bits a vertex",
       [](CodecSettings& s) { s.nearer_child = false; },
       [](const Costs& c) {
         return PerVertex(c, c.meters.connectivity.sides, c.flags.sides.EntropyBits());
       }},
      {"cylindrical, not Cartesian offsets", "fewer", "bits an offset", Cartesian,
       [](const Costs& c) {
         const double children = static_cast<double>(c.offsets.z.values());
         return BitExperiment::Bits{OwnBits(c.meters.offsets.Sum()) / children,
                                    PlainOffsets(c) / children};
       }},
      {"the same, to the last bit", "fewer", "geometry bits a vertex", Cartesian,
       [](const Costs& c) {
         const uint64_t refinement = c.meters.refinement;
         return PerVertex(c, c.meters.offsets.Sum() + refinement,
                          PlainOffsets(c) + OwnBits(refinement));
       }},
  };
  return experiments;
}

}  // namespace folprom::bench
