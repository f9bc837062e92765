#include "tests/bench/peers/simplify_draco.h"

#include <draco/compression/decode.h>
#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <meshoptimizer.h>

#include <limits>
#include <memory>
#include <utility>

#include "folprom/result.h"

namespace folprom::peers {
namespace {

constexpr uint32_t kUnused = ~0U;

// The faces given and the vertices that they use, in the order of their use.
Mesh Compacted(const Mesh& mesh, std::vector<unsigned> indices) {
  std::vector<unsigned> place(mesh.positions.size());
  const size_t used = meshopt_optimizeVertexFetchRemap(place.data(), indices.data(), indices.size(),
                                                       mesh.positions.size());
  Mesh compact;
  compact.positions.resize(used);
  for (size_t v = 0; v < place.size(); ++v) {
    if (place[v] != kUnused) compact.positions[place[v]] = mesh.positions[v];
  }
  for (size_t i = 0; i < indices.size(); i += 3) {
    compact.faces.push_back({place[indices[i]], place[indices[i + 1]], place[indices[i + 2]]});
  }
  return compact;
}

// As draco's own reader of PLY makes it.
std::unique_ptr<draco::Mesh> DracoMesh(const Mesh& mesh) {
  auto result = std::make_unique<draco::Mesh>();
  const auto vertices = static_cast<uint32_t>(mesh.positions.size());
  result->SetNumFaces(mesh.faces.size());
  result->set_num_points(vertices);
  draco::GeometryAttribute description;
  description.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false,
                   3 * sizeof(float), 0);
  draco::PointAttribute* positions =
      result->attribute(result->AddAttribute(description, true, vertices));
  for (uint32_t v = 0; v < vertices; ++v) {
    const Point& p = mesh.positions[v];
    const float xyz[3] = {static_cast<float>(p[0]), static_cast<float>(p[1]),
                          static_cast<float>(p[2])};
    positions->SetAttributeValue(draco::AttributeValueIndex(v), xyz);
  }
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const Triple& face = mesh.faces[f];
    result->SetFace(draco::FaceIndex(f), {draco::PointIndex(face[0]), draco::PointIndex(face[1]),
                                          draco::PointIndex(face[2])});
  }
  result->DeduplicateAttributeValues();
  result->DeduplicatePointIds();
  return result;
}

}  // namespace

SimplifyDraco::SimplifyDraco(const Mesh& mesh) : mesh_(mesh) {
  positions_.reserve(3 * mesh.positions.size());
  for (const Point& p : mesh.positions) {
    for (const double value : p) positions_.push_back(static_cast<float>(value));
  }
}

Mesh SimplifyDraco::Simplified(uint64_t faces) const {
  if (faces >= mesh_.faces.size()) return mesh_;
  constexpr float kAnyError = std::numeric_limits<float>::max();
  std::vector<unsigned> indices(3 * mesh_.faces.size());
  indices.resize(meshopt_simplify(indices.data(), mesh_.faces.front().data(), indices.size(),
                                  positions_.data(), mesh_.positions.size(), 3 * sizeof(float),
                                  3 * faces, kAnyError, 0, nullptr));
  return Compacted(mesh_, std::move(indices));
}

std::vector<char> EncodeDraco(const Mesh& mesh, int bits) {
  draco::Encoder encoder;
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, bits);
  encoder.SetSpeedOptions(0, 0);
  draco::EncoderBuffer buffer;
  const draco::Status status = encoder.EncodeMeshToBuffer(*DracoMesh(mesh), &buffer);
  if (!status.ok()) throw Failure(ErrorKind::kInternal, "Draco: " + status.error_msg_string());
  return *buffer.buffer();
}

Mesh DecodeDraco(const std::vector<char>& bytes) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  auto decoded = draco::Decoder().DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) {
    throw Failure(ErrorKind::kCorrupt, "Draco: " + decoded.status().error_msg_string());
  }
  const std::unique_ptr<draco::Mesh> source = std::move(decoded).value();
  const draco::PointAttribute* positions =
      source->GetNamedAttribute(draco::GeometryAttribute::POSITION);
  Mesh mesh;
  for (uint32_t v = 0; v < source->num_points(); ++v) {
    float xyz[3];
    positions->GetMappedValue(draco::PointIndex(v), xyz);
    mesh.positions.push_back({xyz[0], xyz[1], xyz[2]});
  }
  for (uint32_t f = 0; f < source->num_faces(); ++f) {
    const draco::Mesh::Face& face = source->face(draco::FaceIndex(f));
    mesh.faces.push_back({face[0].value(), face[1].value(), face[2].value()});
  }
  return mesh;
}

}  // namespace folprom::peers
