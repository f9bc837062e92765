// Which elements and properties of a PLY file are the mesh.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/formats/ply_header.h"

namespace folprom::io {

enum class PlyRole : uint8_t { kVertices, kFaces, kStrips, kOther };

/// How the records of one element are read.
struct PlyElementPlan {
  const PlyElement* element = nullptr;
  PlyRole role = PlyRole::kOther;
  /// kVertices: indices of the properties x, y, z.
  std::array<size_t, 3> coordinates{};
  /// kVertices, kFaces: indices of the properties that are attributes, ascending; of faces, lists
  /// only if PlyBlocks::per_corner has them.
  std::vector<size_t> attributes;
  /// kFaces, kStrips: index of the list of vertex indices.
  size_t index_list = 0;
  /// Binary bytes of a record with empty lists.
  uint64_t smallest_record = 0;
  bool has_lists = false;
};

struct PlyLayout {
  std::vector<PlyElementPlan> elements;  ///< in the order of the file, without those of no record
  uint64_t vertex_count = 0;
  ScalarType coordinate_type = ScalarType::kFloat32;
  VertexSchema schema;
  FaceSchema face_schema;
  std::vector<std::string> ignored_properties;
};

/// The plan points into `header`. Throws Failure kInput naming `path` and the element where the
/// file is no mesh: no vertices, a coordinate missing or a list, faces without integer indices.
PlyLayout PlanPlyLayout(const PlyHeader& header, const std::string& path);

/// Completes the plan of the faces. per_corner: of each property how many items its lists have for
/// each corner; 0 for those that are no such lists. keeps_any: false where no attribute of a face
/// can be kept. What is not kept becomes an ignored property.
void PlanFaceAttributes(const std::vector<uint32_t>& per_corner, bool keeps_any,
                        PlyElementPlan& faces, PlyLayout& layout);

}  // namespace folprom::io
