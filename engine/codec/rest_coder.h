// What the lattice of an exact encoding leaves over of each coordinate, after everything else.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/entropy/integer_model.h"
#include "engine/entropy/mixed_model.h"
#include "engine/mesh/exact_lattice.h"
#include "engine/mesh/types.h"

namespace folprom {

/// The encoder's answers.
class RestTruth {
 public:
  virtual ~RestTruth() = default;
  /// Of the only vertex of a set, which stands for it when all sets are split.
  virtual CoordinateRest Rest(uint32_t set, size_t axis) const = 0;
};

/// Numbers of digits follow the size of a coordinate: a float of half the size has one bit more
/// behind the point, and "%g" prints one decimal more below a power of 10. So each size learns how
/// many are usual. The digits themselves are noise.
class RestCoder {
 public:
  explicit RestCoder(const ExactLattice& lattice);

  /// Codes the rests of all vertices. The decoder throws Failure kCorrupt. truth: encoder only.
  template <class Coder>
  std::vector<ExactPosition> Code(Coder& coder, std::span<const Int3> positions,
                                  const RestTruth* truth);

 private:
  template <class Coder>
  CoordinateRest CodeRest(Coder& coder, size_t axis, int64_t whole, const CoordinateRest& truth);
  template <class Coder>
  uint64_t CodeRaw(Coder& coder, uint64_t bits);
  template <class Coder>
  uint64_t CodeDigits(Coder& coder, uint32_t digits, uint64_t value);

  const ExactLattice& lattice_;
  std::vector<uint32_t> usual_;  ///< most digits so far, per axis and size
  MixedModel<1> beyond_;         ///< more digits than ever before, or raw
  MixedModel<1> raw_;
  IntegerModel<1> more_, fewer_;
  MixedModel<1> decimal_;
};

}  // namespace folprom
