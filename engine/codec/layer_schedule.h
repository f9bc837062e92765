// Which spacing and precision each layer brings, as both sides work it out.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "engine/mesh/types.h"
#include "folprom/settings.h"

namespace folprom {

/// The tolerance in lattice units (kUnitsPerTolerance) less what rounding to the lattice may cost
/// twice, with a little left for arithmetic.
inline constexpr double kLeafBound = 30.5;

/// Layers that begin after `begin` or more and before `end` steps are followed by others of the
/// same step, `parts` together.
struct PartedSteps {
  uint32_t begin = 0, end = 0, parts = 1;
};

/// Layers 0 .. split_layers-1 split sets, the rest refine single vertices. The spacing below which
/// sets wait falls by 2^(1/steps_per_octave) a step; in the last split layer nothing waits. The
/// bound on a vertex's cell falls by the same factor a layer and ends at kLeafBound.
///
/// The first layer takes first_steps steps. Where those are more than one, a later layer takes
/// steps until the vertices of a surface, which grow with the square of the spacing, have grown by
/// as many as it had after the first layer: layers of a few vertices cost more to tell than they
/// hold. first_steps = 1: a layer is a step.
///
/// Steps of a range are told in several layers each. A step works down from its largest spacing in
/// rounds, at least one a layer, to each of which it leaves as many sets as to the others; one that
/// asks which sets are due asks once, and its layers take equal shares of the sets.
class LayerSchedule {
 public:
  LayerSchedule() = default;
  LayerSchedule(const Int3& extent, uint32_t steps_per_octave, uint32_t rounds_per_step,
                uint32_t split_layers, uint32_t refine_layers, uint32_t first_steps = 1,
                PartedSteps parted = {});

  uint32_t split_layers() const { return split_layers_; }
  uint32_t refine_layers() const { return refine_layers_; }
  uint32_t first_steps() const { return first_steps_; }
  const PartedSteps& parted() const { return parted_; }
  uint32_t layers() const { return split_layers_ + refine_layers_; }
  uint32_t rounds(uint32_t layer) const;  ///< where the step does not ask
  bool IsLastSplitLayer(uint32_t layer) const { return layer + 1 == split_layers_; }
  /// Layers of its step that come after it, and whether any came before.
  uint32_t parts_left(uint32_t layer) const { return Of(layer).parts - 1 - Of(layer).part; }
  bool BeginsStep(uint32_t layer) const { return Of(layer).part == 0; }
  /// Sets whose spacing is at least this are split by the end of the step; lattice units.
  double SplitSpacing(uint32_t layer) const;
  /// Cells are halved until their bound per axis is at most this; lattice units. In split layers
  /// (settings.split_first off) it follows the spacing.
  double RefineBound(uint32_t layer) const;
  /// Shift of the cells of lattice offsets; those along the normal may be finer.
  uint32_t LatticeShift(uint32_t layer) const;

 private:
  struct SplitLayer {
    uint32_t after = 0;            ///< steps
    uint32_t part = 0, parts = 1;  ///< of the last of them
  };
  /// Of the last split layer: a step of its own.
  SplitLayer Of(uint32_t layer) const {
    return layer < split_.size() ? split_[layer] : SplitLayer{};
  }

  double longest_ = 1;
  uint32_t steps_per_octave_ = 1, rounds_per_step_ = 1;
  uint32_t split_layers_ = 1, refine_layers_ = 0, first_steps_ = 1;
  PartedSteps parted_;
  std::vector<SplitLayer> split_;  ///< all but the last
};

/// Most steps of a first layer.
inline constexpr uint32_t kMostFirstSteps = 255;
/// Steps after which `vertices`, typical_edge lattice units apart on a surface, are represented by
/// least_layer ones or more; 1 where one of the three is not known (0).
uint32_t FirstStepsFor(const Int3& extent, double typical_edge, uint64_t vertices,
                       uint32_t least_layer, uint32_t steps_per_octave);

/// Where parts of steps pay, of a file with so many subtrees.
PartedSteps PartedStepsFor(const Int3& extent, double typical_edge, uint32_t first_steps,
                           const CodecSettings& settings, uint64_t subtrees);

/// Numbers of layers before empty ones are dropped, for vertices `typical_edge` lattice units apart
/// (0: unknown). Sets and cells far from typical share the last split and the first refine layer
/// instead of having many nearly empty ones.
uint32_t SplitLayersFor(const Int3& extent, double typical_edge, uint32_t steps_per_octave,
                        Offsets offsets, uint32_t first_steps = 1, PartedSteps parted = {});
uint32_t RefineLayersFor(const Int3& extent, double typical_edge, uint32_t steps_per_octave,
                         Offsets offsets);

}  // namespace folprom
