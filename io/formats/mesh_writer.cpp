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
      row_bytes_(shape.face_schema.RowBytes()),
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
    WriteVertices(xyz, attributes);
  });
}

Result<void> CountedWriter::AppendFaces(std::span<const Triangle> faces,
                                        std::span<const uint8_t> rows) {
  return ResultOf([&] {
    if (faces.size() > faces_left_) ThrowInternal("more faces are written than were announced");
    faces_left_ -= faces.size();
    CheckIndices(faces);
    CheckRows(faces, rows);
    if (rows.empty() || !HoldsPolygons()) {
      WriteFaces(faces);
      return;
    }
    const size_t face_bytes = shape_.face_schema.FaceBytes();
    for (size_t i = 0; i < faces.size(); ++i) {
      const auto row = rows.subspan(i * row_bytes_, row_bytes_);
      WritePolygon(faces[i], {row.first(face_bytes), row.subspan(face_bytes)});
    }
  });
}

Result<void> CountedWriter::AppendPolygons(std::span<const Triangle> triangles,
                                           std::span<const uint8_t> joins,
                                           std::span<const uint8_t> rows) {
  return ResultOf([&] {
    CheckIndices(triangles);
    CheckRows(triangles, rows);
    const auto begun = static_cast<uint64_t>(std::ranges::count(joins, 0));
    if (begun > faces_left_) ThrowInternal("more faces are written than were announced");
    faces_left_ -= begun;
    if (!HoldsPolygons()) {
      WriteFaces(triangles);
      return;
    }
    const size_t face_bytes = shape_.face_schema.FaceBytes();
    const size_t corner_bytes = shape_.face_schema.CornerBytes();
    for (size_t i = 0; i < triangles.size(); ++i) {
      const auto row = rows.empty() ? rows : rows.subspan(i * row_bytes_, row_bytes_);
      if (joins[i] == 0) {
        EndPolygon();
        corners_.assign(triangles[i].begin(), triangles[i].end());
        if (row.empty()) continue;
        const auto face = row.first(face_bytes), corners = row.subspan(face_bytes);
        face_values_.assign(face.begin(), face.end());
        corner_values_.assign(corners.begin(), corners.end());
      } else {
        corners_.push_back(triangles[i][2]);
        const auto corner = row.empty() ? row : row.last(corner_bytes);
        corner_values_.insert(corner_values_.end(), corner.begin(), corner.end());
      }
    }
  });
}

void CountedWriter::EndPolygon() {
  if (corners_.size() > shape_.largest_face) ThrowInternal("a face has too many corners");
  if (!corners_.empty()) WritePolygon(corners_, {face_values_, corner_values_});
  corners_.clear();
}

void CountedWriter::CheckRows(std::span<const Triangle> triangles,
                              std::span<const uint8_t> rows) const {
  if (rows.size() != triangles.size() * row_bytes_) {
    ThrowInternal("the attributes of faces are not those that were announced");
  }
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
  std::vector<std::string> warnings;
  const auto warn = [&](const char* of, const auto& attributes) {
    std::string names;
    for (const auto& attribute : attributes) {
      if (!Holds(attribute)) names += (names.empty() ? "" : ", ") + attribute.name;
    }
    if (names.empty()) return;
    warnings.push_back(std::string("the format does not hold all attributes of ") + of +
                       ", lost are: " + names);
  };
  warn("vertices", shape_.schema.attributes);
  warn("faces", shape_.face_schema.attributes);
  if (RemarksLost() > 0) {
    warnings.push_back("comments are written to PLY only, lost are " +
                       std::to_string(RemarksLost()));
  }
  return warnings;
}

void CountedWriter::ThrowInternal(const char* reason) const {
  throw Failure(ErrorKind::kInternal, path_ + ": " + reason);
}

}  // namespace folprom::io
