#include "apps/folprom/synth_surface.h"

#include <array>
#include <cmath>

#include "apps/folprom/synth_noise.h"
#include "apps/folprom/synth_strip.h"

namespace folprom::cli {
namespace {

// The components before the last: what part of the vertices they place, where, how large. Together
// clearly below 1, so that the last one gets a good rest whatever the holes take.
struct PlannedPart {
  PartShape shape;
  double share;
  std::array<double, 3> centre;
  double size;
};
constexpr PlannedPart kPlan[] = {{PartShape::kBlob, 0.55, {0, 0, 0}, 100},
                                 {PartShape::kBlob, 0.2, {190, 60, -40}, 55},
                                 {PartShape::kPatch, 0.12, {40, -220, -60}, 90}};
constexpr std::array<double, 3> kLastCentre = {60, 230, -90};
constexpr double kLastSize = 150;

// Below this a component would be nothing but border.
constexpr uint64_t kMinPartSamples = 400;

// Makes one component; gives its vertices and faces.
std::array<uint64_t, 2> MakePart(const Part& part, uint64_t first_vertex, SurfaceSink* sink,
                                 parallel::Progress& progress) {
  StripMesher mesher(part.ring(), first_vertex, sink);
  uint64_t reported = 0;
  for (uint64_t row = 0; row < part.row_count(); ++row) {
    part.FillRow(row, sink != nullptr, mesher.next_row());
    mesher.AddRow();
    progress.Advance(mesher.vertex_count() - reported);
    reported = mesher.vertex_count();
  }
  mesher.Finish();
  return {mesher.vertex_count(), mesher.face_count()};
}

}  // namespace

SynthSurface::SynthSurface(uint64_t vertices, uint64_t seed, parallel::Progress& progress) {
  progress.StartStage("count", vertices);
  const auto add = [&](Part part) {
    const auto [part_vertices, part_faces] = MakePart(part, vertices_, nullptr, progress);
    vertices_ += part_vertices;
    faces_ += part_faces;
    if (part_vertices > 0) parts_.push_back(std::move(part));
  };
  for (const PlannedPart& plan : kPlan) {
    const auto samples = static_cast<uint64_t>(plan.share * static_cast<double>(vertices));
    if (samples < kMinPartSamples) continue;
    add(Part(plan.shape, samples, plan.centre, plan.size, Mix(seed) + parts_.size()));
  }
  const uint64_t rest = vertices - vertices_;
  const double size =
      kLastSize * std::sqrt(static_cast<double>(rest) / static_cast<double>(vertices));
  add(Part(PartShape::kSheet, rest, kLastCentre, size, Mix(seed) + parts_.size()));
}

void SynthSurface::Generate(SurfaceSink& sink, parallel::Progress& progress) const {
  progress.StartStage("write", vertices_);
  uint64_t first_vertex = 0;
  for (const Part& part : parts_) {
    first_vertex += MakePart(part, first_vertex, &sink, progress)[0];
  }
}

}  // namespace folprom::cli
