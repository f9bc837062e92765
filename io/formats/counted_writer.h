// What the writers of all formats check.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "io/files/atomic_file.h"
#include "io/formats/mesh_writer.h"

namespace folprom::io {

/// What a face has beside its corners: FaceSchema.
struct FaceValues {
  std::span<const uint8_t> face;     ///< numbers of the face
  std::span<const uint8_t> corners;  ///< numbers of its corners, corner by corner
};

/// Sees that what comes is what was announced. The functions below may throw Failure.
class CountedWriter : public MeshWriter {
 public:
  Result<void> AppendVertices(std::span<const double> xyz,
                              std::span<const uint8_t> attributes) final;
  Result<void> AppendFaces(std::span<const Triangle> faces, std::span<const uint8_t> rows) final;
  Result<void> AppendPolygons(std::span<const Triangle> triangles, std::span<const uint8_t> joins,
                              std::span<const uint8_t> rows) final;
  Result<void> Commit() final;
  /// Names the attributes, and counts the remarks, that the format does not hold.
  std::vector<std::string> Warnings() const override;

 protected:
  CountedWriter(const std::string& path, const MeshShape& shape, bool force);

  virtual void WriteVertices(std::span<const double> xyz, std::span<const uint8_t> attributes) = 0;
  virtual void WriteFaces(std::span<const Triangle> faces) = 0;
  /// values: as the face schema has them.
  virtual void WritePolygon(std::span<const uint64_t> corners, const FaceValues& values) = 0;
  /// False: polygons are written as triangles.
  virtual bool HoldsPolygons() const { return true; }
  virtual bool Holds(const VertexAttribute&) const { return false; }
  virtual bool Holds(const FaceAttribute&) const { return false; }
  /// How many remarks the file does not have.
  virtual size_t RemarksLost() const { return shape_.remarks.size(); }
  /// Completes the file but for the commit.
  virtual void Finish() = 0;

  const std::string& path() const { return path_; }
  const MeshShape& shape() const { return shape_; }
  AtomicFile& file() { return *file_; }

 private:
  void CheckRows(std::span<const Triangle> triangles, std::span<const uint8_t> rows) const;
  void CheckIndices(std::span<const Triangle> faces) const;
  void EndPolygon();
  [[noreturn]] void ThrowInternal(const char* reason) const;

  std::string path_;
  MeshShape shape_;
  uint64_t vertices_left_;
  uint64_t faces_left_;
  size_t stride_;     ///< bytes of the attributes of a vertex
  size_t row_bytes_;  ///< of the attributes of a triangle
  std::unique_ptr<AtomicFile> file_;
  // Of the polygon that may go on.
  std::vector<uint64_t> corners_;
  std::vector<uint8_t> face_values_, corner_values_;
};

/// All throw Failure.
std::unique_ptr<MeshWriter> MakePlyWriter(const std::string& path, const MeshShape& shape,
                                          bool force);
std::unique_ptr<MeshWriter> MakeStlWriter(const std::string& path, const MeshShape& shape,
                                          bool force);
std::unique_ptr<MeshWriter> MakeObjWriter(const std::string& path, const MeshShape& shape,
                                          bool force);
std::unique_ptr<MeshWriter> MakeOffWriter(const std::string& path, const MeshShape& shape,
                                          bool force);

}  // namespace folprom::io
