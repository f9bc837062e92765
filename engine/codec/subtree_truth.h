// What a SubtreeCoder asks while encoding.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "engine/codec/lod_fit.h"
#include "engine/codec/rest_coder.h"
#include "engine/connectivity/complex.h"
#include "engine/connectivity/face_exceptions.h"
#include "engine/connectivity/split_oracle.h"
#include "engine/geometry/lattice_coder.h"
#include "engine/mesh/coordinate_planes.h"
#include "engine/mesh/types.h"

namespace folprom {

/// What the encoder answers. A "set" is named by the LOD vertex that stands for it.
class SubtreeTruth : public RestTruth {
 public:
  virtual Int3 RootRepresentative() const = 0;
  /// The sets come from rows and columns of regular grids.
  virtual bool OnGrid() const = 0;
  /// Asks for the memory of where a set's node is, once that is there of the node, and then of its
  /// children.
  virtual void PrefetchSet(uint32_t) const {}
  virtual void PrefetchNode(uint32_t) const {}
  virtual void PrefetchChildren(uint32_t) const {}
  /// Number of children of the set, 1 when it is a single vertex.
  virtual uint32_t ChildCount(uint32_t set) const = 0;
  /// What the set adds to the error of an LOD: area times distance, lattice units cubed.
  virtual double Distortion(uint32_t set) const = 0;
  virtual Int3 ChildRepresentative(uint32_t set, uint32_t child) const = 0;
  /// The coder will call the children of the set by their place in `order` (a permutation).
  virtual void BeginSplit(uint32_t set, std::span<const uint32_t> order) = 0;
  /// The next binary split divides `set` into two groups of places; the first keeps its name.
  virtual void BeginBinarySplit(uint32_t set, std::span<const uint32_t> first,
                                std::span<const uint32_t> second) = 0;
  virtual bool FirstTouchesBorder() const = 0;
  virtual bool SecondTouchesBorder() const = 0;
  virtual void EndBinarySplit(uint32_t second_set) = 0;
  /// Position of the only vertex of a set.
  virtual Int3 VertexPosition(uint32_t set) const = 0;
  /// Attributes of the vertex that stands for a set of its own node, as the file has them.
  virtual const uint8_t* Attributes(uint32_t set) const = 0;
  /// How coarse positions may be, at most `coarsest` bits, while the `open` sets are not split.
  virtual LatticePrecision Precision(const Complex& complex, std::span<const uint32_t> open,
                                     uint32_t coarsest) const = 0;
  /// Where the vertices of the LOD are best drawn while the `open` sets are not split.
  virtual FitShares Fit(const SubtreeLod& lod, std::span<const uint32_t> open,
                        const FitShares& before) const = 0;
  /// Coordinates that many vertices share; null where there are none.
  virtual std::shared_ptr<const CoordinatePlanes> Planes() const = 0;
  virtual SplitOracle* oracle() = 0;
  /// Final faces, in terms of `complex`, for the exceptions.
  virtual FaceCensus CountFaces(const Complex& complex) const = 0;
};

}  // namespace folprom
