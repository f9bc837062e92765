// Are order and polygons of a decoded mesh those of a scan.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/folp_file.h"
#include "engine/mesh_sinks.h"
#include "engine/ordered_mesh.h"
#include "folprom/folprom.h"
#include "io/formats/mesh_source.h"
#include "parallel/progress.h"

namespace folprom {

/// Gives each part to both.
class TwoSinks final : public MeshSink {
 public:
  /// second: may be null.
  TwoSinks(MeshSink& first, MeshSink* second) : first_(first), second_(second) {}
  void AddSubtree(const SubtreePart& part) override {
    first_.AddSubtree(part);
    if (second_ != nullptr) second_->AddSubtree(part);
  }
  void AddSeam(std::span<const SeamFace> faces) override {
    first_.AddSeam(faces);
    if (second_ != nullptr) second_->AddSeam(faces);
  }

 private:
  MeshSink& first_;
  MeshSink* second_;
};

/// Decodes the sections of a collected mesh to their end; they check themselves. Throws Failure
/// kCorrupt.
void CheckSections(OrderedMesh& mesh);

/// Compares a collected mesh whose order is kept with the scan, element by element; the reason of
/// the report tells what differs.
void CompareInOrder(const FolpFile& file, OrderedMesh& mesh, const io::MeshSource& source,
                    parallel::Progress& progress, VerifyReport* report);

/// Digest of the polygons of a scan, of the numbers that its vertices have along the curve.
template <class NumberOf>
uint64_t DigestOfPolygons(const io::MeshSource& source, NumberOf number_of) {
  PolygonDigest digest;
  std::vector<io::Triangle> triangles;
  std::vector<uint8_t> joins;
  for (size_t block = 0; block < source.triangle_block_count(); ++block) {
    source.ReadPolygonBlock(block, &triangles, &joins).value();
    for (size_t i = 0; i < triangles.size(); ++i) {
      const io::Triangle& t = triangles[i];
      digest.Add({number_of(t[0]), number_of(t[1]), number_of(t[2])}, joins[i] != 0);
    }
    if (block % 64 == 63) source.DropResident();
  }
  digest.Close();
  return digest.digest();
}

/// The same of the attributes of its faces.
template <class NumberOf>
uint64_t DigestOfFaceValues(const io::MeshSource& source, NumberOf number_of) {
  FaceValueDigest digest(source.face_schema());
  const size_t row_bytes = source.face_schema().RowBytes();
  std::vector<io::Triangle> triangles;
  std::vector<uint8_t> joins, rows;
  for (size_t block = 0; block < source.triangle_block_count(); ++block) {
    source.ReadPolygonBlock(block, &triangles, &joins).value();
    source.ReadFaceAttributes(block, &rows).value();
    for (size_t i = 0; i < triangles.size(); ++i) {
      const io::Triangle& t = triangles[i];
      digest.Add({number_of(t[0]), number_of(t[1]), number_of(t[2])}, joins[i] != 0,
                 std::span(rows).subspan(i * row_bytes, row_bytes));
    }
    if (block % 64 == 63) source.DropResident();
  }
  digest.Close();
  return digest.digest();
}

/// Are the values of vertices those of a scan: those that are rounded within half a step, the
/// others bit by bit. Both as MeshSource::ReadVertexAttributes gives them.
bool AreValuesAlike(const io::FileTable& table, std::span<const uint8_t> decoded,
                    std::span<const uint8_t> original);
/// The reason where they are not.
std::string AttributesDiffer(const io::FileTable& table);
/// Counts in the report what AreValuesAlike compared.
void CountAttributes(const io::FileTable& table, VerifyReport* report);

/// How far a decoded coordinate is from the scan's, and whether their bits differ.
struct CoordinateCheck {
  explicit CoordinateCheck(const FolpFile& file)
      : is_float(static_cast<ScalarType>(file.table().coordinate_type) == ScalarType::kFloat32) {}
  void Add(double decoded, double original);
  /// The reason of the report, where the scan is not what the file promises of it.
  static void Judge(const FolpFile& file, bool same_bits, VerifyReport* report);

  bool is_float;
  bool same_bits = true;
  double largest_error = 0;  ///< infinite where either is not finite
};

}  // namespace folprom
