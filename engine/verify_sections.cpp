#include "engine/verify_sections.h"

#include <algorithm>

#include "engine/verify_values.h"

namespace folprom {
namespace {

void CompareVertices(const FolpFile& file, OrderedMesh& mesh, const io::MeshSource& source,
                     parallel::Progress& progress, VerifyReport* report) {
  CoordinateCheck check(file);
  const bool has_attributes = !file.table().schema.attributes.empty();
  bool same_attributes = true;
  std::vector<double> xyz, decoded;
  std::vector<uint8_t> values, decoded_values;
  const size_t blocks = source.vertex_block_count();
  progress.StartStage("compare vertices", blocks);
  for (size_t b = 0; b < blocks; ++b) {
    progress.ThrowIfCancelled();
    source.ReadVertexBlock(b, &xyz).value();
    mesh.ReadVertices(source.vertex_block_begin(b), xyz.size() / 3, &decoded, &decoded_values);
    for (size_t i = 0; i < xyz.size(); ++i) check.Add(decoded[i], xyz[i]);
    if (has_attributes) {
      source.ReadVertexAttributes(b, &values).value();
      same_attributes &= AreValuesAlike(file.table(), decoded_values, values);
    }
    source.DropResident();
    progress.Advance(1);
  }
  report->max_position_error = check.largest_error;
  CoordinateCheck::Judge(file, check.same_bits, report);
  CountAttributes(file.table(), report);
  if (report->reason.empty() && !same_attributes) report->reason = AttributesDiffer(file.table());
}

/// Gives out the faces of a decoded mesh one at a time.
class FaceStream {
 public:
  explicit FaceStream(OrderedMesh& mesh) : mesh_(mesh) {}
  /// The next triangle, its join and its row; false at the end.
  bool Next(Face* face, bool* is_joined, std::span<const uint8_t>* row) {
    if (at_ == chunk_.triangles.size()) {
      at_ = 0;
      if (!mesh_.ReadFaces(&chunk_)) return false;
    }
    *face = chunk_.triangles[at_];
    *is_joined = !chunk_.joins.empty() && chunk_.joins[at_] != 0;
    const size_t row_bytes = chunk_.rows.size() / chunk_.triangles.size();
    *row = std::span(chunk_.rows).subspan(at_ * row_bytes, row_bytes);
    ++at_;
    return true;
  }

 private:
  OrderedMesh& mesh_;
  FaceChunk chunk_;
  size_t at_ = 0;
};

void CompareFaces(const FolpFile& file, OrderedMesh& mesh, const io::MeshSource& source,
                  parallel::Progress& progress, VerifyReport* report) {
  const bool has_polygons = file.table().Section(io::SectionKind::kPolygons).has_value();
  FaceStream stream(mesh);
  std::vector<io::Triangle> triangles;
  std::vector<uint8_t> joins, rows;
  std::span<const uint8_t> row;
  const size_t blocks = source.triangle_block_count();
  const bool has_values = !file.table().face_schema.empty();
  report->face_attributes = file.table().face_schema.attributes.size();
  progress.StartStage("compare faces", blocks);
  bool alike = true, same_values = true;
  Face face{};
  bool is_joined = false;
  for (size_t b = 0; b < blocks && alike; ++b) {
    progress.ThrowIfCancelled();
    source.ReadPolygonBlock(b, &triangles, &joins).value();
    if (has_values) source.ReadFaceAttributes(b, &rows).value();
    for (size_t i = 0; i < triangles.size() && alike; ++i) {
      alike = stream.Next(&face, &is_joined, &row);
      for (size_t c = 0; c < 3; ++c) alike &= triangles[i][c] == face[c];
      if (has_polygons) alike &= (joins[i] != 0) == is_joined;
      if (alike && has_values) {
        same_values &= std::equal(row.begin(), row.end(), &rows[i * row.size()]);
      }
    }
    source.DropResident();
    progress.Advance(1);
  }
  if (!alike || stream.Next(&face, &is_joined, &row)) {
    report->reason = "the faces of scan and file differ, or their order";
  } else if (!same_values) {
    report->reason = "an attribute of a face differs from that of the scan in its bits";
  }
}

/// The corners of all faces, one after another, with the vertices of the scan.
void CompareSoup(const FolpFile& file, OrderedMesh& mesh, const io::MeshSource& source,
                 parallel::Progress& progress, VerifyReport* report) {
  CoordinateCheck check(file);
  FaceChunk chunk;
  std::vector<double> xyz, decoded;
  size_t at = 0;
  const size_t blocks = source.vertex_block_count();
  progress.StartStage("compare faces", blocks);
  for (size_t b = 0; b < blocks; ++b) {
    progress.ThrowIfCancelled();
    source.ReadVertexBlock(b, &xyz).value();
    for (const double coordinate : xyz) {
      if (at == decoded.size()) {
        at = 0;
        if (!mesh.ReadFaces(&chunk)) {
          report->reason = "the scan has more faces than the file";
          return;
        }
        mesh.ReadCorners(chunk.triangles, &decoded);
      }
      check.Add(decoded[at++], coordinate);
    }
    source.DropResident();
    progress.Advance(1);
  }
  report->max_position_error = check.largest_error;
  CoordinateCheck::Judge(file, check.same_bits, report);
  if (report->reason.empty() && (at != decoded.size() || mesh.ReadFaces(&chunk))) {
    report->reason = "the file has more faces than the scan";
  }
}

}  // namespace

void CheckSections(OrderedMesh& mesh) {
  mesh.Finish();
  FaceChunk chunk;
  while (mesh.ReadFaces(&chunk)) {
  }
}

void CompareInOrder(const FolpFile& file, OrderedMesh& mesh, const io::MeshSource& source,
                    parallel::Progress& progress, VerifyReport* report) {
  mesh.Finish();
  if (file.table().is_soup) {
    CompareSoup(file, mesh, source, progress, report);
    return;
  }
  CompareVertices(file, mesh, source, progress, report);
  if (report->reason.empty()) CompareFaces(file, mesh, source, progress, report);
}

}  // namespace folprom
