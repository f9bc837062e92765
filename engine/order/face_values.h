// What faces and their corners have beside vertices: colours, flags, texture coordinates, any
// number.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/attributes/attribute_model.h"
#include "engine/entropy/mixed_model.h"
#include "engine/order/order_mesh.h"
#include "engine/order/work_space.h"
#include "io/container/file_table.h"

namespace folprom {

/// Codes the values of one triangle after another, those that the triangles of a polygon share
/// once. A value is that of a face or corner coded before at the same vertices, or is coded near
/// them. Encoder and decoder run the same code.
class FaceValueCoder {
 public:
  /// What the models of a column take, about.
  static constexpr uint64_t kModelBytes = uint64_t{56} << 10;

  /// ranges: of the columns of the schema. Borrows the mesh.
  FaceValueCoder(const OrderMesh& mesh, const io::FaceSchema& schema,
                 std::span<const io::AttributeRange> ranges, WorkSpace& space);

  /// Bytes that it keeps of each vertex.
  static size_t VertexBytes(const io::FaceSchema& schema);

  /// triangles: of the numbers of the mesh; joins: as in FaceChunk. rows: see io::FaceSchema; read
  /// by an encoder, written by a decoder.
  template <class Coder>
  void Code(Coder& coder, std::span<const Face> triangles, std::span<const uint8_t> joins,
            std::span<uint8_t> rows);

 private:
  static constexpr uint32_t kGuesses = 3;  ///< values that are asked for one by one
  static constexpr size_t kKept = 2;       ///< corner values that are kept of a vertex
  /// What a column of a face or corner came to: the guess that it was, any other value, not coded.
  enum Outcome : uint32_t { kOther = kGuesses, kNotCoded, kOutcomes };

  struct Column {
    ValueSpan span;
    size_t offset = 0;     ///< of its bytes among those of a face, or of a corner
    uint32_t history = 0;  ///< of the last values: were they the first guess; a bit each
    MixedModel<2> is_guess;
    AttributeModel other;
  };
  /// Numbers of a face, or of a corner.
  struct Group {
    size_t bytes = 0;
    std::vector<Column> columns;    ///< that are not the same everywhere
    std::vector<uint8_t> constant;  ///< what the others are
  };
  /// What may be the value, and what is near it.
  struct Guesses {
    std::array<uint64_t, kGuesses> values{};
    uint32_t count = 0;
    uint32_t context = 0;  ///< below kGuessContexts
    RingValues ring;
  };
  static constexpr uint32_t kGuessContexts = 25;

  void AddColumns(const io::FaceSchema& schema, std::span<const io::AttributeRange> ranges,
                  bool of_corner, Group* group);
  // What is kept of a vertex.
  uint8_t* KeptAt(uint32_t vertex) { return &kept_[vertex * vertex_bytes_]; }
  bool HasFace(uint32_t vertex) { return (KeptAt(vertex)[0] & 1) != 0; }
  size_t CornersAt(uint32_t vertex) { return KeptAt(vertex)[0] >> 1; }
  uint8_t* FaceAt(uint32_t vertex) { return KeptAt(vertex) + 1; }
  uint8_t* CornerAt(uint32_t vertex, size_t which) {
    return FaceAt(vertex) + face_.bytes + which * corner_.bytes;
  }
  void Remember(const Face& triangle, const uint8_t* values);
  void RememberCorner(uint32_t vertex, const uint8_t* values);

  Guesses GuessFace(const Column& column, const Face& triangle);
  Guesses GuessCorner(const Column& column, const Face& triangle, size_t corner,
                      const uint8_t* corners, uint32_t known, bool is_joined);
  /// The third vertex of a triangle at the edge of a and b, but `third`, that keeps values of
  /// corners; kNoNumber where there is none.
  uint32_t VertexAcross(uint32_t a, uint32_t b, uint32_t third);
  /// Codes the columns; guess(column) gives the Guesses.
  template <class Coder, class Guess>
  void CodeGroup(Coder& coder, Group& group, Guess guess, uint8_t* values, Outcome* first);
  template <class Coder>
  uint64_t CodeValue(Coder& coder, Column& column, const Guesses& guesses, Outcome before,
                     Outcome first, uint64_t value, VertexValues* misses, Outcome* outcome);
  template <class Coder>
  void CodeCorner(Coder& coder, const Face& triangle, size_t corner, uint32_t known, bool is_joined,
                  uint8_t* corners);

  const OrderMesh& mesh_;
  WorkSpace& space_;
  Group face_, corner_;
  size_t vertex_bytes_;
  std::span<uint8_t> kept_;  ///< per vertex: what there is, a face, kKept corners
  std::vector<uint8_t> last_face_;
  bool has_last_ = false;
  /// Of the triangle before: its three corners.
  std::vector<uint8_t> last_corners_;
  std::vector<uint8_t> coded_;         ///< the values at hand
  Outcome corner_before_ = kNotCoded;  ///< of the first column of the corner before
};

}  // namespace folprom
