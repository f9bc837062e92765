// Comparing two files, stage by stage.
#include "engine/measure/compare.h"

#include <algorithm>
#include <utility>

#include "engine/measure/directed_distance.h"
#include "engine/run_guarded.h"

namespace folprom {
namespace measure {
namespace {

DistanceStatistics Scaled(const DistanceStatistics& statistics, double scale) {
  return {statistics.mean * scale, statistics.rms * scale, statistics.max * scale};
}

}  // namespace

uint64_t DefaultSamples(uint64_t faces) {
  return std::clamp<uint64_t>(10 * faces, 500'000, 10'000'000);
}

Original::Original(TriangleMesh mesh, const std::string& path, parallel::Runner& runner,
                   parallel::Progress& progress)
    : runner_(runner),
      progress_(progress),
      frame_(mesh, path),
      mesh_(frame_.Inside(std::move(mesh), path)),
      nearest_(mesh_, runner, progress) {}

Comparison Original::Against(TriangleMesh other, const std::string& path, uint64_t samples) {
  if (sample_count_ != samples) {
    samples_ = std::make_unique<SurfaceSamples>(mesh_, samples);
    sample_count_ = samples;
  }
  const TriangleMesh mesh = frame_.Inside(std::move(other), path);
  const NearestSurface nearest(mesh, runner_, progress_);
  const SurfaceSamples other_samples(mesh, samples);
  Comparison comparison;
  comparison.samples = samples;
  comparison.diagonal = frame_.diagonal();
  comparison.forward =
      Scaled(DirectedDistance(*samples_, nearest, "forward", runner_, progress_), frame_.scale());
  comparison.backward = Scaled(
      DirectedDistance(other_samples, nearest_, "backward", runner_, progress_), frame_.scale());
  return comparison;
}

}  // namespace measure

Result<Comparison> CompareFiles(const std::string& a, const std::string& b,
                                const CompareOptions& options, parallel::Runner& runner,
                                parallel::Progress& progress) {
  return RunGuarded<Comparison>([&] {
    measure::ReadOptions read;
    read.decode.limits = options.limits;
    read.decode.temporary_folder = options.temporary_folder;
    measure::TriangleMesh first = measure::ReadMesh(a, read, runner, progress);
    measure::TriangleMesh second = measure::ReadMesh(b, read, runner, progress);
    const uint64_t faces = std::max(first.faces.size(), second.faces.size());
    const uint64_t samples = options.samples > 0 ? options.samples : measure::DefaultSamples(faces);
    progress.StartStage("build", 0);
    measure::Original original(std::move(first), a, runner, progress);
    return original.Against(std::move(second), b, samples);
  });
}

}  // namespace folprom
