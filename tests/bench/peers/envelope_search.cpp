#include "tests/bench/peers/envelope_search.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <utility>

#include "engine/measure/compare.h"
#include "tests/bench/peers/mesh_file.h"
#include "tests/bench/peers/simplify_draco.h"

namespace folprom::peers {
namespace {

constexpr int kFewestBits = 4, kMostBits = 18;
constexpr uint64_t kSearchSamples = 200'000;
/// A file is close enough to its budget from this part of it on.
constexpr double kFull = 0.995;
constexpr int kSteps = 7, kStepsWithoutFit = 14;
constexpr double kFewestFaces = 4;

struct Candidate {
  int position_bits = 0;
  double faces_asked = 0;  ///< of the simplifier
  uint64_t vertices = 0, faces = 0;
  std::vector<char> file;
  double error = 0;  ///< mean, part of the diagonal
};

measure::TriangleMesh Measurable(const Mesh& mesh) { return {mesh.positions, mesh.faces}; }

class EnvelopeJob {
 public:
  EnvelopeJob(const std::string& scan, parallel::Runner& runner, parallel::Progress& progress)
      : scan_(scan),
        mesh_(ReadMesh(scan)),
        coder_(mesh_),
        original_(Measurable(mesh_), scan, runner, progress) {}

  Envelope Run(std::span<const double> rates, uint64_t samples) {
    Envelope envelope;
    envelope.vertices = mesh_.positions.size();
    envelope.faces = mesh_.faces.size();
    envelope.samples = samples > 0 ? samples : measure::DefaultSamples(mesh_.faces.size());
    for (const double rate : rates) {
      const std::optional<Candidate> best = BestAt(rate);
      if (!best) {
        fmt::print(stderr, "{}: nothing fits into {:g} bits per vertex\n", scan_, rate);
        continue;
      }
      envelope.points.push_back(PointOf(*best, rate, envelope.samples));
      const EnvelopePoint& point = envelope.points.back();
      fmt::print(stderr, "{}: at {:g} bits per vertex {} faces with {} bits: error {:.3f}e-4\n",
                 scan_, rate, point.faces, point.position_bits, 1e4 * point.error.mean);
    }
    return envelope;
  }

 private:
  // The error over the number of bits falls, then rises: from the best one of the rate before, walk
  // both ways as long as it gets better.
  std::optional<Candidate> BestAt(double rate) {
    const auto budget =
        static_cast<uint64_t>(rate * static_cast<double>(mesh_.positions.size()) / 8);
    std::map<int, std::optional<Candidate>> tried;
    const auto at = [&](int bits) -> const std::optional<Candidate>& {
      if (!tried.contains(bits)) tried[bits] = LargestWithin(budget, bits);
      return tried[bits];
    };
    const auto better = [&](int a, int b) {
      return at(a) && (!at(b) || at(a)->error < at(b)->error);
    };
    int first = first_bits_;
    while (!at(first) && first > kFewestBits) --first;
    int best = first;
    for (const int step : {1, -1}) {
      // Two steps beyond the last gain, so that one unlucky simplification does not end the walk.
      int gain = first;
      for (int bits = first + step;
           bits >= kFewestBits && bits <= kMostBits && std::abs(bits - gain) <= 2; bits += step) {
        if (better(bits, gain)) gain = bits;
      }
      if (better(gain, best)) best = gain;
    }
    if (at(best)) first_bits_ = best;
    return at(best);
  }

  // The size is nearly proportional to the face count: correct the count by the ratio, and keep the
  // largest that fits. Small files jump, so each miss in a row steps back further.
  std::optional<Candidate> LargestWithin(uint64_t budget, int bits) {
    const auto all = static_cast<double>(mesh_.faces.size());
    const auto wanted = static_cast<double>(budget);
    std::optional<Candidate> best;
    double too_many = std::numeric_limits<double>::infinity();
    double faces = std::clamp(all * wanted / SizeOfAll(bits), kFewestFaces, all);
    int misses = 0;
    for (int step = 0; step < (best ? kSteps : kStepsWithoutFit); ++step) {
      Candidate candidate = Coded(static_cast<uint64_t>(faces), bits);
      const double part = static_cast<double>(candidate.file.size()) / wanted;
      const double correction = (1 + kFull) / 2 / part;
      if (part > 1) {
        if (faces <= kFewestFaces) break;
        too_many = std::min(too_many, faces);
        faces *= std::min(correction, 1 - 0.005 * std::ldexp(1, std::min(misses++, 5)));
        if (best && faces <= best->faces_asked) break;
        faces = std::max(faces, kFewestFaces);
        continue;
      }
      misses = 0;
      if (!best || candidate.faces > best->faces) best = std::move(candidate);
      if (part >= kFull || faces >= all) break;
      faces = std::min({faces * correction, all, std::sqrt(faces * too_many)});
    }
    if (best) Measure(&*best);
    return best;
  }

  double SizeOfAll(int bits) {
    double& size = size_of_all_[bits];
    if (size == 0) size = static_cast<double>(Coded(mesh_.faces.size(), bits).file.size());
    return size;
  }

  Candidate Coded(uint64_t faces, int bits) {
    const Mesh simplified = coder_.Simplified(faces);
    return {bits,
            static_cast<double>(faces),
            simplified.positions.size(),
            simplified.faces.size(),
            EncodeDraco(simplified, bits),
            0};
  }

  void Measure(Candidate* candidate) {
    candidate->error = ErrorOf(*candidate, kSearchSamples).mean;
    fmt::print(stderr, "{}: {} faces, {} bits: {:.3f} bits per vertex, error {:.3f}e-4\n", scan_,
               candidate->faces, candidate->position_bits, RateOf(*candidate),
               1e4 * candidate->error);
  }

  DistanceStatistics ErrorOf(const Candidate& candidate, uint64_t samples) {
    const Comparison comparison =
        original_.Against(Measurable(DecodeDraco(candidate.file)), scan_, samples);
    const DistanceStatistics &a = comparison.forward, &b = comparison.backward;
    return {std::max(a.mean, b.mean) / comparison.diagonal,
            std::max(a.rms, b.rms) / comparison.diagonal,
            std::max(a.max, b.max) / comparison.diagonal};
  }

  double RateOf(const Candidate& candidate) const {
    return 8 * static_cast<double>(candidate.file.size()) /
           static_cast<double>(mesh_.positions.size());
  }

  EnvelopePoint PointOf(const Candidate& best, double rate, uint64_t samples) {
    return {rate,          RateOf(best), best.file.size(),      best.position_bits,
            best.vertices, best.faces,   ErrorOf(best, samples)};
  }

  const std::string scan_;
  const Mesh mesh_;
  const SimplifyDraco coder_;
  measure::Original original_;
  std::map<int, double> size_of_all_;  ///< bytes without simplification, by position bits
  int first_bits_ = 9;                 ///< where the search begins
};

}  // namespace

Envelope SearchEnvelope(const std::string& scan, std::span<const double> rates, uint64_t samples,
                        parallel::Runner& runner, parallel::Progress& progress) {
  return EnvelopeJob(scan, runner, progress).Run(rates, samples);
}

}  // namespace folprom::peers
