// Encoder: how far off the mesh the vertices of an LOD are best drawn.
#pragma once

#include <cstdint>
#include <span>

#include "engine/codec/lod_fit.h"

namespace folprom {

/// A vertex of the mesh.
struct FitSample {
  uint32_t set = 0;  ///< of the LOD, that it belongs to
  Int3 position;
};
/// As many are enough to choose by.
inline constexpr size_t kFitSamples = 1024;

/// The shares that bring the LOD's faces nearest to the samples. Shares that are hardly worse stay
/// what they were `before`.
FitShares ChooseFit(const SubtreeLod& lod, std::span<const FitSample> samples,
                    const FitShares& before);

}  // namespace folprom
