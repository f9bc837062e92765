// What the sources of OBJ, STL and OFF have in common: a mapped file and what its walk found.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "io/files/mapped_file.h"
#include "io/formats/mesh_source.h"
#include "io/result_of.h"

namespace folprom::io {

/// What a source knows after its walk.
struct SourceIndex {
  uint64_t vertices = 0;
  uint64_t triangles = 0;
  uint64_t block_vertices = kBlockVertices;  ///< of each block but the last
  size_t triangle_blocks = 0;
  ScalarType coordinate_type = ScalarType::kFloat32;
  SourceNotes notes;
  VertexSchema schema;
  FaceSchema face_schema;
  std::vector<std::string> remarks;
};

/// Answers from the index all but the two reads.
class IndexedSource : public MeshSource {
 public:
  const std::string& path() const override { return file_.path(); }
  uint64_t vertex_count() const override { return index_.vertices; }
  uint64_t triangle_count() const override { return index_.triangles; }
  ScalarType coordinate_type() const override { return index_.coordinate_type; }
  size_t vertex_block_count() const override {
    return index_.vertices / index_.block_vertices + (index_.vertices % index_.block_vertices > 0);
  }
  uint64_t vertex_block_begin(size_t block) const override {
    return std::min<uint64_t>(block * index_.block_vertices, index_.vertices);
  }
  size_t triangle_block_count() const override { return index_.triangle_blocks; }
  const VertexSchema& vertex_schema() const override { return index_.schema; }
  const FaceSchema& face_schema() const override { return index_.face_schema; }
  const std::vector<std::string>& remarks() const override { return index_.remarks; }
  const SourceNotes& notes() const override { return index_.notes; }
  Result<void> CheckUnchanged() const override {
    return ResultOf([&] { file_.CheckUnchanged(); });
  }
  void DropResident() const override { file_.DropResident(); }

 protected:
  explicit IndexedSource(MappedFile file) : file_(std::move(file)) {}

  const MappedFile& file() const { return file_; }
  uint64_t VerticesIn(size_t block) const {
    return vertex_block_begin(block + 1) - vertex_block_begin(block);
  }

  SourceIndex index_;

 private:
  MappedFile file_;
};

}  // namespace folprom::io
