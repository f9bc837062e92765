// Writes binary little-endian PLY in one pass, counts known beforehand.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "folprom/result.h"
#include "io/formats/mesh_source.h"

namespace folprom::io {

/// Writes `x y z` as float or double and `property list uchar int vertex_indices` (uint where the
/// vertex count needs it). Vertices and faces may be appended in any interleaving (they go to
/// separate offsets), each in order. Goes to a temporary file beside the target until Commit.
/// Not thread-safe.
class PlyWriter {
 public:
  /// coordinate_type: kFloat32 or kFloat64. `force`: may replace an existing file; kOutput
  /// otherwise.
  static Result<std::unique_ptr<PlyWriter>> Create(const std::string& path, uint64_t vertex_count,
                                                   uint64_t face_count, ScalarType coordinate_type,
                                                   bool force);
  virtual ~PlyWriter() = default;
  /// As float: rounded, or the very bits where WidenFloat made the value.
  virtual Result<void> AppendVertices(std::span<const double> xyz) = 0;
  virtual Result<void> AppendFaces(std::span<const Triangle> faces) = 0;
  /// Checks that as many came as were announced (kInternal), syncs and renames into place.
  virtual Result<void> Commit() = 0;
};

}  // namespace folprom::io
