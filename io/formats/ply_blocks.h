// One walk over the body of a PLY file: is all there, and where does each block begin.
#pragma once

#include <cstdint>
#include <vector>

#include "io/files/mapped_file.h"
#include "io/formats/ply_layout.h"
#include "io/formats/ply_place.h"
#include "io/formats/ply_triangles.h"

namespace folprom::io {

/// Where the triangles of a block begin: at a record, or inside of the list of one.
struct PlyTriangleBlock {
  size_t plan = 0;  ///< index into PlyLayout::elements
  FilePosition position;
  uint64_t record = 0;
  uint64_t items_left = 0;  ///< of the list at `position`; 0 where a record begins there
  PlyListState state;       ///< of that list
  uint64_t triangles = 0;   ///< of the block
};

struct PlyBlocks {
  std::vector<FilePosition> vertices;  ///< one for each kBlockVertices vertices
  std::vector<PlyTriangleBlock> triangles;
  uint64_t triangle_count = 0;
  /// Of each property of the faces: how many items its lists have for each corner; 0 where it is no
  /// list, or not of each face the same.
  std::vector<uint32_t> per_corner;
  bool cuts_faces = false;  ///< a block begins inside of a face
  SourceNotes notes;        ///< without the ignored properties
};

/// Walks the body once, with a bounded resident size. Throws Failure kInput for a file that holds
/// fewer bytes than its header needs, and for contradictory lists.
PlyBlocks IndexPlyBlocks(const MappedFile& file, const PlyHeader& header, const PlyLayout& layout);

}  // namespace folprom::io
