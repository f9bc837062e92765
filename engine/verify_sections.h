// Are order, polygons and attributes of faces of a decoded mesh those of a scan.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/folp_file.h"
#include "engine/order/face_value_digest.h"
#include "engine/order/polygon_digest.h"
#include "engine/ordered_mesh.h"
#include "folprom/folprom.h"
#include "io/formats/mesh_source.h"
#include "parallel/progress.h"

namespace folprom {

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

}  // namespace folprom
