// The precision of positions on the lattice, layer by layer.
#pragma once

#include <array>
#include <cstdint>

#include "engine/entropy/mixed_model.h"
#include "engine/geometry/lattice_coder.h"

namespace folprom {

class PrecisionCoder {
 public:
  PrecisionCoder() : same_({2}) {}

  /// Cells of 2^shift lattice steps, where `chosen` (encoder only), not coarser, says finer.
  template <class Coder>
  void Code(Coder& coder, uint32_t shift, const LatticePrecision& chosen);
  /// As much finer than `shift` as the layer before was.
  void Follow(uint32_t shift);
  const LatticePrecision& precision() const { return precision_; }

 private:
  template <class Coder>
  uint32_t CodeFiner(Coder& coder, uint32_t which, uint32_t finer);

  /// Bits by which positions are finer than the schedule says: along the surface, and across it
  /// once more.
  std::array<uint32_t, 2> finer_{0, 0};
  MixedModel<1> same_;
  LatticePrecision precision_;
};

}  // namespace folprom
