#include "engine/verify_sections.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "engine/attributes/value.h"
#include "folprom/float_bits.h"

namespace folprom {
namespace {

/// Of a step: rounding to the type, of which a step is at least 4 spacings, may add an eighth.
constexpr double kHalf = 0.5 + 0.125;

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

bool AreValuesAlike(const io::FileTable& table, std::span<const uint8_t> decoded,
                    std::span<const uint8_t> original) {
  if (decoded.size() != original.size()) return false;
  const size_t stride = table.schema.Stride();
  size_t offset = 0;
  for (size_t a = 0; a < table.schema.attributes.size(); ++a) {
    const ScalarType type = table.schema.attributes[a].type;
    const double step = table.attribute_ranges[a].step;
    for (size_t at = offset; at < decoded.size(); at += stride) {
      const uint64_t back = OrderedOf(type, &decoded[at]), was = OrderedOf(type, &original[at]);
      if (step == 0 ? back != was
                    : !(std::fabs(RealOf(type, back) - RealOf(type, was)) <= kHalf * step)) {
        return false;
      }
    }
    offset += ScalarSize(type);
  }
  return true;
}

std::string AttributesDiffer(const io::FileTable& table) {
  const bool any_rounded = std::ranges::any_of(
      table.attribute_ranges, [](const io::AttributeRange& range) { return range.step > 0; });
  return std::string("an attribute differs from that of the scan in its bits") +
         (any_rounded ? ", or by more than half a step" : "");
}

void CountAttributes(const io::FileTable& table, VerifyReport* report) {
  report->attributes = table.schema.attributes.size();
  for (const io::AttributeRange& range : table.attribute_ranges) {
    report->rounded_attributes += range.step > 0 ? 1 : 0;
  }
}

void CoordinateCheck::Add(double decoded, double original) {
  if (is_float) decoded = WidenFloat(std::bit_cast<float>(NarrowToFloatBits(decoded)));
  if (std::bit_cast<uint64_t>(decoded) == std::bit_cast<uint64_t>(original)) return;
  same_bits = false;
  // A NaN would be lost among the errors of other vertices.
  const double error = std::fabs(decoded - original);
  largest_error = std::max(largest_error,
                           std::isfinite(error) ? error : std::numeric_limits<double>::infinity());
}

void CoordinateCheck::Judge(const FolpFile& file, bool same_bits, VerifyReport* report) {
  if (file.lattice().exact) {
    if (!same_bits) report->reason = "a coordinate differs from that of the scan in its bits";
    return;
  }
  // The last digits of the subtraction itself are no error of the coder.
  if (report->max_position_error > report->tolerance * (1 + 1e-9)) {
    report->reason = "a position is off by more than the tolerance";
  }
}

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
