// What both sides know before the first bit: settings, lattice, and the schedule of layers.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/attributes/value_model.h"
#include "engine/codec/layer_schedule.h"
#include "engine/connectivity/split_coder.h"
#include "engine/entropy/initial_statistics.h"
#include "engine/geometry/lattice_coder.h"
#include "engine/geometry/offset_coder.h"
#include "engine/mesh/exact_lattice.h"
#include "engine/mesh/types.h"
#include "folprom/result.h"
#include "folprom/settings.h"

namespace folprom {

/// Settings of the coder as one value.
struct CodecParameters {
  CodecSettings settings;
  Int3 extent;
  LayerSchedule schedule;
  std::optional<ExactLattice> exact;  ///< positions are coded bit for bit
  std::vector<ValueSpan> attributes;  ///< of the vertices, Offsets::kLattice only
  /// Other statistics than InitialStatistics::Trained, while those are made.
  const InitialStatistics* statistics = nullptr;

  /// Most children of a split.
  uint32_t children() const {
    return settings.hierarchy == Hierarchy::kQuadric ? 2 : settings.children;
  }
  bool fits_lods() const { return settings.lod_fit && settings.offsets == Offsets::kLattice; }
  bool has_light_models() const { return settings.models == Models::kLight; }
  bool has_rests() const { return exact && exact->step.has_rests; }
  /// Where models start; null: at nothing.
  const InitialStatistics* start() const;
  OffsetSettings offsets() const;
  ConnectivitySettings connectivity() const;
  LatticeSettings lattice() const;
};

/// The codec's own bytes in the table of the file, and back. The schedule's counts are part of
/// them.
std::vector<uint8_t> WriteParameters(const CodecParameters& parameters);
/// Throws Failure kCorrupt. Of an exact lattice radix, exponent and has_rests are known; the rest
/// stands in the table.
CodecParameters ReadParameters(std::span<const uint8_t> bytes, const Int3& extent);

}  // namespace folprom
