#include "io/formats/mesh_writer.h"

#include <algorithm>

#include "io/formats/counted_writer.h"
#include "io/result_of.h"

namespace folprom::io {

Result<MeshFormat> OutputFormat(const std::string& path) {
  if (const std::optional<MeshFormat> format = FormatByEnding(path)) return *format;
  return Error{ErrorKind::kUsage,
               path + ": the ending tells no format (known: .ply, .obj, .stl, .off)"};
}

Result<std::unique_ptr<MeshWriter>> MeshWriter::Create(const std::string& path,
                                                       const MeshShape& shape, bool force) {
  return ResultOf([&] {
    switch (OutputFormat(path).value()) {
      case MeshFormat::kObj:
        return MakeObjWriter(path, shape, force);
      case MeshFormat::kStl:
        return MakeStlWriter(path, shape, force);
      case MeshFormat::kOff:
        return MakeOffWriter(path, shape, force);
      case MeshFormat::kPly:
        break;
    }
    return MakePlyWriter(path, shape, force);
  });
}

CountedWriter::CountedWriter(const std::string& path, const MeshShape& shape, bool force)
    : path_(path),
      shape_(shape),
      vertices_left_(shape.vertices),
      faces_left_(shape.faces),
      stride_(shape.schema.Stride()),
      file_(AtomicFile::Create(path, force).value()) {}

Result<void> CountedWriter::AppendVertices(std::span<const double> xyz,
                                           std::span<const uint8_t> attributes) {
  return ResultOf([&] {
    if (xyz.size() % 3 != 0 || xyz.size() / 3 > vertices_left_) {
      ThrowInternal("more vertices are written than were announced");
    }
    if (attributes.size() != xyz.size() / 3 * stride_) {
      ThrowInternal("the attributes written are not those that were announced");
    }
    vertices_left_ -= xyz.size() / 3;
    WriteVertices(xyz, HoldsAttributes() ? attributes : std::span<const uint8_t>());
  });
}

Result<void> CountedWriter::AppendFaces(std::span<const Triangle> faces) {
  return ResultOf([&] {
    if (faces.size() > faces_left_) ThrowInternal("more faces are written than were announced");
    faces_left_ -= faces.size();
    CheckIndices(faces);
    WriteFaces(faces);
  });
}

Result<void> CountedWriter::AppendPolygons(std::span<const Triangle> triangles,
                                           std::span<const uint8_t> joins) {
  return ResultOf([&] {
    CheckIndices(triangles);
    const auto begun = static_cast<uint64_t>(std::ranges::count(joins, 0));
    if (begun > faces_left_) ThrowInternal("more faces are written than were announced");
    faces_left_ -= begun;
    if (!HoldsPolygons()) {
      WriteFaces(triangles);
      return;
    }
    for (size_t i = 0; i < triangles.size(); ++i) {
      if (joins[i] == 0) {
        EndPolygon();
        corners_.assign(triangles[i].begin(), triangles[i].end());
      } else {
        corners_.push_back(triangles[i][2]);
      }
    }
  });
}

void CountedWriter::EndPolygon() {
  if (corners_.size() > shape_.largest_face) ThrowInternal("a face has too many corners");
  if (!corners_.empty()) WritePolygon(corners_);
  corners_.clear();
}

void CountedWriter::CheckIndices(std::span<const Triangle> faces) const {
  for (const Triangle& face : faces) {
    for (const uint64_t index : face) {
      if (index >= shape_.vertices) ThrowInternal("a face has an index beyond the vertices");
    }
  }
}

Result<void> CountedWriter::Commit() {
  return ResultOf([&] {
    if (vertices_left_ != 0 || faces_left_ != 0) {
      ThrowInternal("fewer vertices or faces are written than were announced");
    }
    EndPolygon();
    Finish();
    file_->Commit().value();
  });
}

std::vector<std::string> CountedWriter::Warnings() const {
  if (HoldsAttributes()) return {};
  std::vector<std::string> warnings;
  if (!shape_.schema.attributes.empty()) {
    std::string names;
    for (const VertexAttribute& attribute : shape_.schema.attributes) {
      names += (names.empty() ? "" : ", ") + attribute.name;
    }
    warnings.push_back("attributes of vertices are written to PLY only, lost are: " + names);
  }
  if (!shape_.remarks.empty()) {
    warnings.push_back("comments are written to PLY only, lost are " +
                       std::to_string(shape_.remarks.size()));
  }
  return warnings;
}

void CountedWriter::ThrowInternal(const char* reason) const {
  throw Failure(ErrorKind::kInternal, path_ + ": " + reason);
}

}  // namespace folprom::io
