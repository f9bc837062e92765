#include "apps/folprom/synth_surface.h"

#include <array>
#include <cmath>
#include <utility>

#include "apps/folprom/synth_noise.h"
#include "apps/folprom/synth_part.h"
#include "apps/folprom/synth_range.h"
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

// Cameras around the object, on two levels. The board gets the rest.
constexpr uint64_t kViews = 6;
constexpr double kViewsShare = 0.87;
constexpr double kRises[] = {0.04, -0.03};

// Below this a component would be nothing but border.
constexpr uint64_t kMinPartSamples = 400;

// Makes one component; gives its vertices and faces.
std::array<uint64_t, 2> MakePart(const RowSource& part, uint64_t first_vertex, SurfaceSink* sink,
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

SynthSurface::SynthSurface(SynthKind kind, uint64_t vertices, uint64_t seed,
                           parallel::Progress& progress) {
  progress.StartStage("count", vertices, "vertices");
  if (kind == SynthKind::kScan) {
    PlanScan(vertices, seed, progress);
  } else {
    PlanRange(vertices, seed, progress);
  }
}

void SynthSurface::Add(std::unique_ptr<RowSource> part, uint64_t most,
                       parallel::Progress& progress) {
  const auto [part_vertices, part_faces] = MakePart(*part, vertices_, nullptr, progress);
  if (part_vertices == 0 || part_vertices > most) return;
  vertices_ += part_vertices;
  faces_ += part_faces;
  parts_.push_back(std::move(part));
}

void SynthSurface::PlanScan(uint64_t vertices, uint64_t seed, parallel::Progress& progress) {
  for (const PlannedPart& plan : kPlan) {
    const auto samples = static_cast<uint64_t>(plan.share * static_cast<double>(vertices));
    if (samples < kMinPartSamples) continue;
    Add(std::make_unique<Part>(plan.shape, samples, plan.centre, plan.size,
                               Mix(seed) + parts_.size()),
        vertices, progress);
  }
  const uint64_t rest = vertices - vertices_;
  const double size =
      kLastSize * std::sqrt(static_cast<double>(rest) / static_cast<double>(vertices));
  Add(std::make_unique<Part>(PartShape::kSheet, rest, kLastCentre, size, Mix(seed) + parts_.size()),
      rest, progress);
}

void SynthSurface::PlanRange(uint64_t vertices, uint64_t seed, parallel::Progress& progress) {
  const double in_view = kViewsShare * static_cast<double>(vertices) / kViews;
  const double pitch = std::sqrt(RangeView::PixelsSeen(1) / in_view);
  for (uint64_t view = 0; view < kViews; ++view) {
    if (in_view < kMinPartSamples) break;
    const double turn = static_cast<double>(view) / kViews;
    // What is left must do for a board.
    Add(std::make_unique<RangeView>(pitch, turn, kRises[view % 2], seed, Mix(seed) + view + 1),
        vertices - vertices_ - kMinVertices, progress);
  }
  const uint64_t rest = vertices - vertices_;
  Add(std::make_unique<RangeBoard>(rest, pitch, Mix(seed)), rest, progress);
}

void SynthSurface::Generate(SurfaceSink& sink, parallel::Progress& progress) const {
  progress.StartStage("write", vertices_, "vertices");
  uint64_t first_vertex = 0;
  for (const auto& part : parts_) {
    first_vertex += MakePart(*part, first_vertex, &sink, progress)[0];
  }
}

}  // namespace folprom::cli
