// A scan file as the engine sees it: blocks of positions and blocks of triangles, any format.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "folprom/limits.h"
#include "folprom/result.h"
#include "folprom/scalar_type.h"
#include "io/formats/face_schema.h"
#include "io/formats/vertex_schema.h"

namespace folprom::io {

class MappedFile;

/// Three vertex indices of the file, in the order of the file.
using Triangle = std::array<uint64_t, 3>;

/// Vertices and triangles of a block, at most.
constexpr uint64_t kBlockVertices = 65536;
constexpr uint64_t kBlockTriangles = 65536;

/// Things that were read but not kept as they were; each is worth a warning.
struct SourceNotes {
  uint64_t polygons_triangulated = 0;  ///< faces of more than three corners, split as a fan
  uint64_t polygons_dropped = 0;       ///< faces of fewer than three corners
  uint64_t strips = 0;                 ///< triangle strips unrolled
  std::vector<std::string> ignored_properties;  ///< what else the file has, as its format calls it
  uint64_t remarks_dropped = 0;  ///< lines beyond Limits::comment_bytes, or not of text
};

/// A scan file, mapped into memory and parsed on demand. Thread-safe after Open: every Read may be
/// called from several threads at once. Errors name the file, the element and the place.
class MeshSource {
 public:
  virtual ~MeshSource() = default;

  /// Opens a PLY, OBJ, STL or OFF file, known by its content and only then by its ending. Walks the
  /// file once, so that truncation and bad counts are found here (kInput), and indexes the blocks.
  /// kLimit where it has more of anything than `limits` allow.
  static Result<std::unique_ptr<MeshSource>> Open(const std::string& path,
                                                  const Limits& limits = {});
  /// The same of a file that is mapped already.
  static Result<std::unique_ptr<MeshSource>> OfMapped(MappedFile file, const Limits& limits = {});

  virtual const std::string& path() const = 0;
  virtual uint64_t vertex_count() const = 0;
  /// Exact number of triangles that all blocks give together.
  virtual uint64_t triangle_count() const = 0;
  /// Type of the coordinates in the file (the widest of x, y, z). Where the format has no types:
  /// kFloat64 if any coordinate is not what float32 holds, else kFloat32 (text_number.h).
  virtual ScalarType coordinate_type() const = 0;

  virtual size_t vertex_block_count() const = 0;
  /// Index of the first vertex of a block; vertex_block_begin(vertex_block_count()) is
  /// vertex_count(). A block holds at most 65,536 vertices.
  virtual uint64_t vertex_block_begin(size_t block) const = 0;
  /// Replaces *xyz by the block's positions, three doubles a vertex. kInput where a value does not
  /// parse. NaN and infinity are passed on, bit for bit (folprom/float_bits.h).
  virtual Result<void> ReadVertexBlock(size_t block, std::vector<double>* xyz) const = 0;

  /// What else each vertex has; nothing in most formats.
  virtual const VertexSchema& vertex_schema() const {
    static const VertexSchema kNothing;
    return kNothing;
  }
  /// Replaces *values by those of the block: vertex by vertex, for each the attributes in their
  /// order, lowest byte first, every bit kept. kInput where a value does not parse.
  virtual Result<void> ReadVertexAttributes(size_t /*block*/, std::vector<uint8_t>* values) const {
    values->clear();
    return {};
  }
  /// What else each face has; nothing in most formats.
  virtual const FaceSchema& face_schema() const {
    static const FaceSchema kNothing;
    return kNothing;
  }
  /// Replaces *rows by those of the block's triangles: see FaceSchema. kInput where a value does
  /// not parse.
  virtual Result<void> ReadFaceAttributes(size_t /*block*/, std::vector<uint8_t>* rows) const {
    rows->clear();
    return {};
  }
  /// Lines of the header that say "comment" or "obj_info", whole.
  virtual const std::vector<std::string>& remarks() const {
    static const std::vector<std::string> kNone;
    return kNone;
  }

  virtual size_t triangle_block_count() const = 0;
  /// Replaces *triangles by the block's triangles (at most about 65,536, more only for one huge
  /// polygon). kInput, with the face's index, where an index is negative or not below
  /// vertex_count().
  Result<void> ReadTriangleBlock(size_t block, std::vector<Triangle>* triangles) const {
    return ReadFaces(block, triangles, nullptr);
  }
  /// The same, and for each triangle 1 where it goes on with the polygon of the triangle before it,
  /// maybe of the block before; 0 where a face begins. The corners of a polygon are those of its
  /// first triangle and the last one of each further triangle.
  Result<void> ReadPolygonBlock(size_t block, std::vector<Triangle>* triangles,
                                std::vector<uint8_t>* joins) const {
    joins->clear();
    return ReadFaces(block, triangles, joins);
  }

  virtual const SourceNotes& notes() const = 0;

  /// kInput where the file has been written or cut since it was opened: what was read of it before
  /// and after may not belong together.
  virtual Result<void> CheckUnchanged() const { return {}; }

  /// Tells the kernel that the resident pages of the mapping may go (they stay in its cache). The
  /// resident size of a pass over the file is then bounded by what lies between two calls.
  virtual void DropResident() const = 0;

 protected:
  /// Both reads; *joins is empty, or there is none.
  virtual Result<void> ReadFaces(size_t block, std::vector<Triangle>* triangles,
                                 std::vector<uint8_t>* joins) const = 0;
};

}  // namespace folprom::io
