// The attributes of a subtree's vertices: those of a new vertex are predicted from its neighbours.
//
// Encoder and decoder run the same code.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/attributes/attribute_model.h"
#include "engine/attributes/value_model.h"
#include "engine/connectivity/complex.h"
#include "engine/geometry/local_frame.h"
#include "engine/mesh/types.h"

namespace folprom {

/// A vertex that a split has just made.
struct NewVertex {
  const Complex& complex;
  std::span<const Int3> positions;  ///< of all vertices
  uint32_t vertex = 0;              ///< the last one
  uint32_t parent = 0;              ///< what was split
};

class AttributeCoder {
 public:
  /// What the models of an attribute take, about.
  static constexpr uint64_t kModelBytes = uint64_t{48} << 10;

  /// Attributes in the order of the file.
  explicit AttributeCoder(std::span<const ValueSpan> spans);

  /// Bytes of the attributes of a vertex.
  size_t stride() const { return stride_; }
  /// Of the first vertex. truth: its values as the file has them; encoder only.
  template <class Coder>
  void CodeRoot(Coder& coder, const uint8_t* truth);
  /// meters: null, or the cost of each attribute.
  template <class Coder>
  void CodeNew(Coder& coder, const NewVertex& added, const uint8_t* truth,
               std::vector<uint64_t>* meters);

  /// Of all vertices by number, as the file has them.
  std::vector<uint8_t> Values() const;

 private:
  /// An attribute that is not the same everywhere.
  struct Column {
    ValueSpan span;
    size_t attribute = 0;  ///< its place among all
    size_t offset = 0;     ///< of its bytes among those of a vertex
  };
  /// A neighbour of the new vertex.
  struct Neighbour {
    uint32_t vertex = 0;
    double weight = 0;  ///< 1 over the distance
  };

  void CollectNeighbours(const NewVertex& added);
  /// What the neighbours say of a column.
  RingValues Look(size_t column, uint32_t parent) const;
  /// The length that nx and ny of the vertex leave to nz, where the column is nz.
  std::optional<double> RestOfNormal(size_t column, uint32_t vertex) const;
  double Real(uint32_t vertex, size_t column) const {
    return RealOf(columns_[column].span, ordered_[vertex * columns_.size() + column]);
  }

  std::vector<ValueSpan> spans_;
  size_t stride_ = 0;
  std::vector<Column> columns_;
  std::vector<AttributeModel> models_;  ///< per column; none before there is a second vertex
  std::vector<uint64_t> ordered_;       ///< vertex by vertex, a number per column
  uint32_t vertices_ = 0;
  bool has_normals_ = false;
  std::vector<Neighbour> ring_;
  Vector3 surface_normal_{};  ///< at the new vertex; 0 without faces
};

}  // namespace folprom
