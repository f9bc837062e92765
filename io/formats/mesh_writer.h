// Writes a mesh as a file of the format that its ending names.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "folprom/result.h"
#include "io/formats/mesh_format.h"
#include "io/formats/mesh_source.h"

namespace folprom::io {

/// What is known of a mesh before its first vertex.
struct MeshShape {
  uint64_t vertices = 0;
  uint64_t faces = 0;
  ScalarType coordinate_type = ScalarType::kFloat32;  ///< written as double where kFloat64
  VertexSchema schema = {};
  FaceSchema face_schema = {};
  std::vector<std::string> remarks = {};  ///< lines for the header: IsRemark
  /// Where there are polygons: of what they are cut into, and corners of the largest.
  uint64_t triangles = 0, largest_face = 3;
};

/// The format that an output of this name has; kUsage with the known endings for any other.
Result<MeshFormat> OutputFormat(const std::string& path);

/// Vertices and faces may be appended in any interleaving, each in order; memory stays bounded. All
/// goes to temporary files beside the target until Commit. Not thread-safe. Text has the shortest
/// decimals that give the same floats back.
class MeshWriter {
 public:
  /// `force`: may replace an existing file; kOutput otherwise. kLimit where the format cannot count
  /// so far.
  static Result<std::unique_ptr<MeshWriter>> Create(const std::string& path, const MeshShape& shape,
                                                    bool force);
  virtual ~MeshWriter() = default;
  /// Three coordinates a vertex. As float: rounded, or the very bits where WidenFloat made them.
  /// attributes: of the same vertices, as MeshSource::ReadVertexAttributes gives them.
  virtual Result<void> AppendVertices(std::span<const double> xyz,
                                      std::span<const uint8_t> attributes = {}) = 0;
  /// rows: of the same faces, as MeshSource::ReadFaceAttributes gives them.
  virtual Result<void> AppendFaces(std::span<const Triangle> faces,
                                   std::span<const uint8_t> rows = {}) = 0;
  /// Faces as MeshSource::ReadPolygonBlock gives them; one may go on in the next call. Not to be
  /// mixed with AppendFaces.
  virtual Result<void> AppendPolygons(std::span<const Triangle> triangles,
                                      std::span<const uint8_t> joins,
                                      std::span<const uint8_t> rows = {}) = 0;
  /// Checks that as many came as were announced (kInternal), syncs and renames into place.
  virtual Result<void> Commit() = 0;
  /// After Commit: what of the mesh the format does not hold, a sentence each.
  virtual std::vector<std::string> Warnings() const = 0;
};

}  // namespace folprom::io
