#include "engine/codec/layer_schedule.h"

#include <bit>
#include <cmath>

#include "engine/entropy/fixed_math.h"
#include "engine/mesh/lattice.h"

namespace folprom {
namespace {

constexpr double kLog2 = 0.69314718055994530942;

/// Cells in split layers are this much smaller than the spacing when leaves do not wait.
constexpr double kCellsPerSpacing = 16;

/// New vertices of lattice offsets have this many cells per spacing.
constexpr double kLatticeCellsPerSpacing = 12;

/// The first layer's spacing as a part of the longest side: layers before it would hold a few dozen
/// vertices, less than the table says of them.
constexpr double kFirstSpacing = 4;

/// Steps that a schedule is worked out for; one of more is refused when it is read.
constexpr uint32_t kMostSteps = 4096;

/// Typical edges: where sets lie no further apart most are single vertices, and a step is little.
constexpr double kLeastParted = 1;

double HalvedBy(double value, double octaves) {
  uint32_t whole = static_cast<uint32_t>(octaves);
  value = value * ExpExact(-(octaves - static_cast<double>(whole)) * kLog2);
  for (uint32_t i = 0; i < whole; ++i) value = value / 2;
  return value;
}

/// Steps after the layer that begins when `done` are done.
uint32_t NextStep(uint32_t done, uint32_t first_steps, uint32_t steps_per_octave) {
  if (first_steps == 1) return done + 1;
  // Vertices over those after the first layer. Two octaves on a step adds more than one of them.
  const auto vertices = [&](uint32_t steps) {
    return ExpExact(2 * kLog2 * static_cast<double>(steps - first_steps) / steps_per_octave);
  };
  if (done - first_steps >= 2 * steps_per_octave) return done + 1;
  const double grown = vertices(done) + 1;
  while (vertices(++done) < grown) {
  }
  return done;
}

/// Layers that the steps behind the first `done` are.
uint32_t PartsAfter(uint32_t done, const PartedSteps& parted) {
  return done >= parted.begin && done < parted.end ? parted.parts : 1;
}

double Longest(const Int3& extent) {
  return static_cast<double>(std::max({extent.x, extent.y, extent.z, 1}));
}

}  // namespace

LayerSchedule::LayerSchedule(const Int3& extent, uint32_t steps_per_octave,
                             uint32_t rounds_per_step, uint32_t split_layers,
                             uint32_t refine_layers, uint32_t first_steps, PartedSteps parted)
    : longest_(Longest(extent)),
      steps_per_octave_(steps_per_octave),
      rounds_per_step_(rounds_per_step),
      split_layers_(split_layers),
      refine_layers_(refine_layers),
      first_steps_(first_steps),
      parted_(parted) {
  uint32_t done = 0, next = first_steps;
  while (split_.size() + 1 < split_layers && split_.size() < kMostSteps) {
    const uint32_t parts = PartsAfter(done, parted);
    for (uint32_t part = 0; part < parts && split_.size() + 1 < split_layers; ++part) {
      split_.push_back({next, part, parts});
    }
    done = next;
    next = NextStep(done, first_steps, steps_per_octave);
  }
}

uint32_t LayerSchedule::rounds(uint32_t layer) const {
  if (layer >= split_layers_ || IsLastSplitLayer(layer)) return 1;
  return std::max(rounds_per_step_ / Of(layer).parts, 1u);
}

double LayerSchedule::SplitSpacing(uint32_t layer) const {
  if (IsLastSplitLayer(layer)) return 0;
  return HalvedBy(longest_ / kFirstSpacing,
                  static_cast<double>(Of(layer).after) / static_cast<double>(steps_per_octave_));
}

double LayerSchedule::RefineBound(uint32_t layer) const {
  if (layer < split_layers_) {
    return std::max(kLeafBound, SplitSpacing(layer) / kCellsPerSpacing);
  }
  double bound = kLeafBound;
  uint32_t steps = layers() - 1 - layer;
  bound = bound * ExpExact(static_cast<double>(steps % steps_per_octave_) * kLog2 /
                           static_cast<double>(steps_per_octave_));
  for (uint32_t i = 0; i < steps / steps_per_octave_; ++i) bound = bound * 2;
  return bound;
}

uint32_t LayerSchedule::LatticeShift(uint32_t layer) const {
  if (layer >= split_layers_) return layers() - 1 - layer;
  // The last split layer has no spacing of its own.
  uint32_t measured = IsLastSplitLayer(layer) && layer > 0 ? layer - 1 : layer;
  auto cells = static_cast<uint64_t>(SplitSpacing(measured) / kLatticeCellsPerSpacing);
  return cells < 2 ? 0 : static_cast<uint32_t>(std::bit_width(cells)) - 1;
}

uint32_t FirstStepsFor(const Int3& extent, double typical_edge, uint64_t vertices,
                       uint32_t least_layer, uint32_t steps_per_octave) {
  if (!(typical_edge > 0) || vertices == 0 || least_layer == 0) return 1;
  const double apart = typical_edge * std::sqrt(static_cast<double>(vertices) / least_layer);
  const double ratio = std::max(Longest(extent) / kFirstSpacing / apart, 1.0);
  const double steps = Log2Exact(ratio) * steps_per_octave;
  return static_cast<uint32_t>(std::clamp(std::ceil(steps), 1.0, double{kMostFirstSteps}));
}

PartedSteps PartedStepsFor(const Int3& extent, double typical_edge, uint32_t first_steps,
                           const CodecSettings& settings, uint64_t subtrees) {
  if (settings.step_parts == 1 || first_steps == 1) return {};
  // Tables and checksums take this many times as much for a layer as those of a single subtree.
  const double cost = (3 + static_cast<double>(std::min<uint64_t>(subtrees, 1u << 20))) / 4;
  const double per_octave = settings.steps_per_octave;
  const double begin = first_steps + std::floor(Log2Exact(cost) * per_octave / 2);
  const double octaves =
      Log2Exact(std::max(Longest(extent) / kFirstSpacing / (kLeastParted * typical_edge), 1.0));
  const double end = std::floor(octaves * per_octave);
  if (!(begin < end)) return {};
  return {static_cast<uint32_t>(begin), static_cast<uint32_t>(end), settings.step_parts};
}

uint32_t SplitLayersFor(const Int3& extent, double typical_edge, uint32_t steps_per_octave,
                        Offsets offsets, uint32_t first_steps, PartedSteps parted) {
  double least = offsets == Offsets::kLattice ? 1 : 2 * kUnitsPerTolerance;
  double finest = std::max(typical_edge / 2, least);
  double octaves = std::max(Log2Exact(Longest(extent) / finest), 0.0);
  const uint32_t steps = static_cast<uint32_t>(octaves * steps_per_octave) + 1;
  uint32_t layers = 2;
  for (uint32_t done = first_steps; done < steps;) {
    const uint32_t next = NextStep(done, first_steps, steps_per_octave);
    layers += PartsAfter(done, parted);
    done = next;
  }
  return layers;
}

uint32_t RefineLayersFor(const Int3& extent, double typical_edge, uint32_t steps_per_octave,
                         Offsets offsets) {
  if (offsets == Offsets::kLattice) {
    // A bit per layer, from the cells of the last split layer on.
    double cells = (typical_edge > 0 ? typical_edge : Longest(extent)) / kLatticeCellsPerSpacing;
    return static_cast<uint32_t>(std::bit_width(static_cast<uint64_t>(cells))) + 1;
  }
  double coarsest = typical_edge > 0 ? typical_edge / 16 : Longest(extent);
  double octaves = std::max(Log2Exact(coarsest / kLeafBound), 0.0);
  return static_cast<uint32_t>(octaves * steps_per_octave) + 1;
}

}  // namespace folprom
