#include "io/formats/ply_layout.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include "io/formats/ply_scalar.h"

namespace folprom::io {
namespace {

[[noreturn]] void Fail(const std::string& path, const PlyElement& element,
                       const std::string& reason) {
  throw Failure(ErrorKind::kInput, path + ": element " + element.name + ": " + reason);
}

PlyRole RoleOf(const PlyElement& element) {
  if (element.name == "vertex") return PlyRole::kVertices;
  if (element.name == "face") return PlyRole::kFaces;
  if (element.name == "tristrips") return PlyRole::kStrips;
  return PlyRole::kOther;
}

std::optional<size_t> PropertyNamed(const PlyElement& element, std::string_view name) {
  for (size_t i = 0; i < element.properties.size(); ++i) {
    if (element.properties[i].name == name) return i;
  }
  return std::nullopt;
}

/// The larger type; float64 for float32 with 32-bit integers, which it would round. Of a signed and
/// an unsigned type of one size either: what is written as float takes the values of both.
ScalarType Wider(ScalarType a, ScalarType b) {
  using enum ScalarType;
  const auto is_int32 = [](ScalarType type) { return type == kInt32 || type == kUint32; };
  if ((a == kFloat32 && is_int32(b)) || (b == kFloat32 && is_int32(a))) return kFloat64;
  return std::max(a, b);
}

void PlanVertices(const std::string& path, PlyElementPlan& plan, PlyLayout& layout) {
  static constexpr std::string_view kNames[] = {"x", "y", "z"};
  const PlyElement& element = *plan.element;
  for (size_t axis = 0; axis < 3; ++axis) {
    const std::string name(kNames[axis]);
    const std::optional<size_t> index = PropertyNamed(element, name);
    if (!index) Fail(path, element, "has no property " + name);
    const PlyProperty& property = element.properties[*index];
    if (property.is_list) Fail(path, element, "the property " + name + " is a list");
    plan.coordinates[axis] = *index;
    layout.coordinate_type =
        axis == 0 ? property.type : Wider(layout.coordinate_type, property.type);
  }
  layout.vertex_count = element.count;
}

/// Every scalar of a vertex beside its position, as far as there is room.
void PlanAttributes(PlyElementPlan& plan, VertexSchema& schema) {
  const std::vector<PlyProperty>& properties = plan.element->properties;
  for (size_t i = 0; i < properties.size(); ++i) {
    if (i == plan.coordinates[0]) schema.before_position = schema.attributes.size();
    if (std::ranges::find(plan.coordinates, i) != plan.coordinates.end()) continue;
    const PlyProperty& property = properties[i];
    if (property.is_list || !IsAttributeName(property.name) ||
        schema.attributes.size() == kMostAttributes) {
      continue;
    }
    plan.attributes.push_back(i);
    schema.attributes.push_back({property.name, property.type});
  }
}

void PlanIndexList(const std::string& path, PlyElementPlan& plan) {
  const PlyElement& element = *plan.element;
  std::optional<size_t> index = PropertyNamed(element, "vertex_indices");
  if (!index) index = PropertyNamed(element, "vertex_index");
  if (!index) Fail(path, element, "has no property vertex_indices or vertex_index");
  const PlyProperty& property = element.properties[*index];
  if (!property.is_list) Fail(path, element, "the property " + property.name + " is not a list");
  if (IsFloat(property.type)) {
    Fail(path, element, "the property " + property.name + " is not of an integer type");
  }
  plan.index_list = *index;
}

/// What may be an attribute of a face: the walk tells which lists are.
bool IsFaceCandidate(const PlyElementPlan& plan, size_t property) {
  return plan.role == PlyRole::kFaces && property != plan.index_list;
}

bool IsCoded(const PlyElementPlan& plan, size_t property) {
  switch (plan.role) {
    case PlyRole::kVertices:
      return std::ranges::find(plan.coordinates, property) != plan.coordinates.end() ||
             std::ranges::binary_search(plan.attributes, property);
    case PlyRole::kFaces:  // all the others are candidates
    case PlyRole::kStrips:
      return property == plan.index_list;
    case PlyRole::kOther:
      return false;
  }
  return false;
}

}  // namespace

PlyLayout PlanPlyLayout(const PlyHeader& header, const std::string& path) {
  PlyLayout layout;
  bool has_vertices = false;
  for (const PlyElement& element : header.elements) {
    PlyElementPlan plan;
    plan.element = &element;
    plan.role = RoleOf(element);
    if (plan.role == PlyRole::kVertices) {
      PlanVertices(path, plan, layout);
      PlanAttributes(plan, layout.schema);
      has_vertices = true;
    }
    // An element of no record holds nothing, whatever its properties; one of no property as well.
    if (element.count == 0) continue;
    if (plan.role == PlyRole::kFaces || plan.role == PlyRole::kStrips) PlanIndexList(path, plan);
    if (element.properties.empty()) continue;

    for (size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      plan.has_lists |= property.is_list;
      plan.smallest_record += ScalarSize(property.is_list ? property.count_type : property.type);
      if (!IsCoded(plan, i) && !IsFaceCandidate(plan, i)) {
        layout.ignored_properties.push_back(element.name + "." + property.name);
      }
    }
    layout.elements.push_back(plan);
  }
  if (!has_vertices) throw Failure(ErrorKind::kInput, path + ": has no element vertex");
  return layout;
}

void PlanFaceAttributes(const std::vector<uint32_t>& per_corner, bool keeps_any,
                        PlyElementPlan& faces, PlyLayout& layout) {
  const std::vector<PlyProperty>& properties = faces.element->properties;
  FaceSchema& schema = layout.face_schema;
  for (size_t i = 0; i < properties.size(); ++i) {
    const PlyProperty& property = properties[i];
    if (i == faces.index_list) {
      schema.before_indices = schema.attributes.size();
      continue;
    }
    const FaceAttribute attribute{property.name, property.type, per_corner[i]};
    const bool kept = keeps_any && IsFaceAttributeName(property.name) &&
                      property.is_list == (attribute.per_corner > 0) &&
                      schema.HasRoomFor(attribute);
    if (!kept) {
      layout.ignored_properties.push_back(faces.element->name + "." + property.name);
      continue;
    }
    faces.attributes.push_back(i);
    schema.attributes.push_back(attribute);
  }
}

}  // namespace folprom::io
