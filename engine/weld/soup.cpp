#include "engine/weld/soup.h"

#include <algorithm>
#include <vector>

#include "engine/kept_attributes.h"

namespace folprom {

bool IsSoup(const io::MeshSource& source) {
  if (source.triangle_count() == 0 || source.vertex_count() != 3 * source.triangle_count()) {
    return false;
  }
  std::vector<io::Triangle> triangles;
  uint64_t next = 0;
  for (size_t block = 0; block < source.triangle_block_count(); ++block) {
    source.ReadTriangleBlock(block, &triangles).value();
    const bool is_soup = std::ranges::all_of(triangles, [&next](const io::Triangle& triangle) {
      return std::ranges::all_of(triangle, [&next](uint64_t vertex) { return vertex == next++; });
    });
    if (!is_soup) return false;
    if (block % 64 == 63) source.DropResident();
  }
  return true;
}

WeldKind WeldFor(const io::MeshSource& source, const EncodeOptions& options) {
  const bool keeps = KeepsAttributes(options);
  const bool has_attributes = keeps && !source.vertex_schema().attributes.empty();
  if (!options.weld) {
    const bool as_it_is = has_attributes || (keeps && !source.face_schema().empty());
    return !as_it_is && IsSoup(source) ? WeldKind::kSoup : WeldKind::kAsItIs;
  }
  if (has_attributes) {
    throw Failure(ErrorKind::kInput,
                  source.path() +
                      ": vertices with attributes are not welded, for these may differ where the "
                      "coordinates are equal; weld goes with attributes = false");
  }
  return WeldKind::kSurface;
}

}  // namespace folprom
