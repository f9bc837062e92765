// A mesh that is another one with something changed.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "io/formats/mesh_source.h"

namespace folprom::io {

/// Answers all as the other one does. Thread-safe as that.
class DerivedSource : public MeshSource {
 public:
  /// As it was.
  const MeshSource& scan() const { return *scan_; }

  const std::string& path() const override { return scan_->path(); }
  uint64_t vertex_count() const override { return scan_->vertex_count(); }
  uint64_t triangle_count() const override { return scan_->triangle_count(); }
  ScalarType coordinate_type() const override { return scan_->coordinate_type(); }
  size_t vertex_block_count() const override { return scan_->vertex_block_count(); }
  uint64_t vertex_block_begin(size_t block) const override {
    return scan_->vertex_block_begin(block);
  }
  Result<void> ReadVertexBlock(size_t block, std::vector<double>* xyz) const override {
    return scan_->ReadVertexBlock(block, xyz);
  }
  const VertexSchema& vertex_schema() const override { return scan_->vertex_schema(); }
  Result<void> ReadVertexAttributes(size_t block, std::vector<uint8_t>* values) const override {
    return scan_->ReadVertexAttributes(block, values);
  }
  const FaceSchema& face_schema() const override { return scan_->face_schema(); }
  Result<void> ReadFaceAttributes(size_t block, std::vector<uint8_t>* rows) const override {
    return scan_->ReadFaceAttributes(block, rows);
  }
  const std::vector<std::string>& remarks() const override { return scan_->remarks(); }
  size_t triangle_block_count() const override { return scan_->triangle_block_count(); }
  const SourceNotes& notes() const override { return scan_->notes(); }
  Result<void> CheckUnchanged() const override { return scan_->CheckUnchanged(); }
  void DropResident() const override { scan_->DropResident(); }

 protected:
  explicit DerivedSource(std::unique_ptr<MeshSource> scan) : scan_(std::move(scan)) {}

  Result<void> ReadFaces(size_t block, std::vector<Triangle>* triangles,
                         std::vector<uint8_t>* joins) const override {
    return joins == nullptr ? scan_->ReadTriangleBlock(block, triangles)
                            : scan_->ReadPolygonBlock(block, triangles, joins);
  }

 private:
  std::unique_ptr<MeshSource> scan_;
};

}  // namespace folprom::io
