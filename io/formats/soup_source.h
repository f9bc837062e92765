// A mesh whose facets share no vertices.
#pragma once

#include <vector>

#include "io/formats/indexed_source.h"

namespace folprom::io {

/// Triangle i is of the vertices 3i, 3i + 1 and 3i + 2; blocks hold whole facets.
class SoupSource : public IndexedSource {
 protected:
  using IndexedSource::IndexedSource;

  static constexpr uint64_t kBlockFacets = kBlockVertices / 3;

  /// Sets all of the index but the type and the notes.
  void SetFacets(uint64_t facets) {
    index_.triangles = facets;
    index_.vertices = 3 * facets;
    index_.block_vertices = 3 * kBlockFacets;
    index_.triangle_blocks = vertex_block_count();
  }

 private:
  Result<void> ReadFaces(size_t block, std::vector<Triangle>* triangles,
                         std::vector<uint8_t>* joins) const override {
    const uint64_t begin = vertex_block_begin(block);
    triangles->resize(VerticesIn(block) / 3);
    for (uint64_t i = 0; i < triangles->size(); ++i) {
      const uint64_t first = begin + 3 * i;
      (*triangles)[i] = {first, first + 1, first + 2};
    }
    if (joins != nullptr) joins->assign(triangles->size(), 0);
    return {};
  }
};

}  // namespace folprom::io
