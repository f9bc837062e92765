#include "engine/codec/encode_subtree.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <span>

#include "engine/codec/border_seam_truth.h"
#include "engine/codec/seam_coder.h"
#include "engine/codec/tree_truth.h"
#include "engine/entropy/bit_coder.h"
#include "engine/hierarchy/lloyd_tree.h"
#include "engine/hierarchy/quadric_tree.h"
#include "engine/hierarchy/surface.h"
#include "engine/mesh/digest.h"
#include "engine/mesh/lattice.h"

namespace folprom {
namespace {

void CheckTolerance(const SubtreeChunk& chunk, const std::vector<Int3>& positions,
                    const std::vector<uint32_t>& final_vertices, Offsets offsets) {
  const int32_t most =
      offsets == Offsets::kLattice ? 0 : static_cast<int32_t>(kUnitsPerTolerance) - 1;
  for (size_t i = 0; i < chunk.positions.size(); ++i) {
    const Int3 &a = chunk.positions[i], &b = positions[final_vertices[i]];
    int32_t error = std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
    if (error > most) {
      throw Failure(ErrorKind::kInternal, "a refined position misses the tolerance");
    }
  }
}

/// As decoded, bit for bit; empty where the encoding is not exact.
std::vector<ExactPosition> ExactPositionsOf(const SubtreeCoder& coder,
                                            const CodecParameters& parameters) {
  if (!parameters.exact || parameters.has_rests()) return coder.exact_positions();
  std::vector<ExactPosition> exact;
  for (const Int3& p : coder.positions()) {
    const ExactLattice& lattice = *parameters.exact;
    exact.push_back({lattice.ToModel(0, p.x), lattice.ToModel(1, p.y), lattice.ToModel(2, p.z)});
  }
  return exact;
}

void CheckBits(const SubtreeChunk& chunk, const std::vector<ExactPosition>& exact,
               const std::vector<uint32_t>& final_vertices) {
  for (size_t i = 0; i < chunk.exact.size(); ++i) {
    if (std::memcmp(&chunk.exact[i], &exact[final_vertices[i]], sizeof(ExactPosition)) != 0) {
      throw Failure(ErrorKind::kInternal, "an exact position differs from that of the scan");
    }
  }
}

void CheckAttributes(const SubtreeChunk& chunk, const std::vector<uint8_t>& coded,
                     const std::vector<uint32_t>& final_vertices) {
  const size_t stride = chunk.attributes.size() / chunk.positions.size();
  for (size_t i = 0; stride > 0 && i < chunk.positions.size(); ++i) {
    const uint8_t* here = &coded[final_vertices[i] * stride];
    if (std::memcmp(&chunk.attributes[i * stride], here, stride) != 0) {
      throw Failure(ErrorKind::kInternal, "an attribute differs from that of the scan");
    }
  }
}

template <class Position>
void Digest(std::span<const Position> positions, std::span<const uint8_t> attributes,
            const std::vector<Face>& faces, io::MeshDigest* digest) {
  AddVertices(digest, positions, attributes);
  for (const Face& f : faces) AddFace(digest, positions[f[0]], positions[f[1]], positions[f[2]]);
}

}  // namespace

SetTree BuildSetTree(const SubtreeChunk& chunk, uint32_t subtree,
                     const CodecParameters& parameters) {
  const CodecSettings& settings = parameters.settings;
  if (settings.hierarchy == Hierarchy::kQuadric) {
    return BuildQuadricTree(chunk.positions, chunk.faces, chunk.cross_faces, subtree, settings);
  }
  const Int3& extent = parameters.extent;
  double longest = std::max({extent.x, extent.y, extent.z});
  SurfaceAttributes surface =
      MeasureSurface(chunk.positions, chunk.faces, chunk.cross_faces, subtree);
  return BuildLloydTree(chunk.positions, surface, longest, settings);
}

uint64_t EncodeSubtreeBytes(const SubtreeSummary& summary, const CodecParameters& parameters) {
  // Per vertex: tree and points 220, complex and cells 560, exact positions as read, as coded and
  // at the border 72, of each attribute 8 and twice what the file has. Per face: oracle and chunk
  // 142.
  const uint64_t per_vertex = (parameters.exact ? 852 : 780) + 24 * parameters.attributes.size();
  const uint64_t models = parameters.attributes.size() * AttributeCoder::kModelBytes;
  return (uint64_t{1} << 20) + models + uint64_t{summary.vertices} * per_vertex +
         (summary.faces + summary.cross_faces) * 142;
}

EncodedSubtree EncodeSubtree(const SubtreeChunk& chunk, const SubtreeSummary& summary,
                             uint32_t subtree, const CodecParameters& parameters,
                             const CostMeters& meters,
                             const std::function<void(SubtreeCoder&)>& after_layer) {
  const SetTree tree = BuildSetTree(chunk, subtree, parameters);
  TreeTruth truth(chunk, subtree, tree, parameters);
  SubtreeShape shape;
  shape.vertices = summary.vertices;
  shape.box_lo = summary.box_lo;
  shape.box_hi = summary.box_hi;
  shape.has_border = !summary.neighbours.empty();
  SubtreeCoder coder(parameters, shape);
  BitEncoder bits;
  EncodedSubtree result;
  result.meters = meters;
  result.meters.attributes.resize(parameters.attributes.size(), 0);
  for (uint32_t layer = 0; layer < parameters.schedule.layers(); ++layer) {
    const uint64_t before = bits.decisions();
    const std::vector<Int3> positions = coder.positions();
    coder.CodeLayer(bits, &truth, &result.meters);
    // A position may follow from what is known without any decision.
    result.active.push_back(bits.decisions() > before || coder.positions() != positions);
    result.segments.push_back(bits.TakeSegment());
    result.distance.push_back(truth.LargestDistance(coder.positions()));
    result.vertices.push_back(static_cast<uint32_t>(coder.positions().size()));
    result.faces.push_back(coder.face_count());
    if (after_layer) after_layer(coder);
  }
  result.final_vertices = truth.FinalVertices();
  CheckTolerance(chunk, coder.positions(), result.final_vertices, parameters.settings.offsets);

  const std::vector<Int3>& positions = coder.positions();
  const std::vector<ExactPosition> exact = ExactPositionsOf(coder, parameters);
  CheckBits(chunk, exact, result.final_vertices);
  const std::vector<uint8_t> attributes = coder.Attributes();
  CheckAttributes(chunk, attributes, result.final_vertices);
  std::vector<Face> faces;
  coder.AppendFaces(&faces);
  if (parameters.exact) {
    Digest<ExactPosition>(exact, attributes, faces, &result.digest);
  } else {
    Digest<Int3>(positions, attributes, faces, &result.digest);
  }

  result.border = coder.border();
  for (uint32_t v = 0; v < result.final_vertices.size(); ++v) {
    uint32_t border = coder.BorderOf(result.final_vertices[v]);
    if (border == kNone) continue;
    auto& known = result.border_vertices;
    if (border >= known.original.size()) {
      known.original.resize(border + size_t{1});
      known.position.resize(border + size_t{1});
    }
    known.original[border] = v;
    known.position[border] = positions[result.final_vertices[v]];
    if (!parameters.exact) continue;
    known.exact.resize(known.position.size());
    known.exact[border] = exact[result.final_vertices[v]];
  }
  return result;
}

uint64_t EncodeSeamBytes(uint64_t border_bytes, uint64_t cross_faces) {
  // A border vertex takes 56 bytes in the file and as many as a vertex of a subtree in the complex;
  // a cross face stands in the chunk and in the oracle.
  return (uint64_t{1} << 20) + border_bytes * 12 + cross_faces * (sizeof(CrossFace) + 110);
}

EncodedSeam EncodeSeam(const std::vector<uint32_t>& subtrees,
                       const std::vector<BorderFile>& borders,
                       std::span<const CrossFace> cross_faces, const CodecParameters& parameters) {
  std::vector<SeamMember> members;
  std::vector<SeamCoder::Participant> participants;
  for (size_t i = 0; i < subtrees.size(); ++i) {
    members.push_back({subtrees[i], &borders[i].record, borders[i].vertices.original});
    participants.push_back({subtrees[i], &borders[i].record});
  }
  BorderSeamTruth truth(members, cross_faces);
  SeamCoder coder(parameters, participants, SubtreeShape().mesh_faces);
  BitEncoder bits;
  EncodedSeam result;
  for (uint32_t layer = 0; layer < parameters.schedule.layers(); ++layer) {
    uint64_t before = bits.decisions();
    coder.CodeLayer(bits, &truth, &result.meter);
    result.active.push_back(bits.decisions() > before);
    result.segments.push_back(bits.TakeSegment());
    result.faces.push_back(coder.face_count());
  }
  std::vector<SeamFace> faces;
  coder.AppendFaces(&faces);
  auto vertices = [&](const BorderRef& ref) -> const BorderVertices& {
    size_t i = 0;
    while (subtrees[i] != ref.subtree) ++i;
    return borders[i].vertices;
  };
  auto position = [&](const BorderRef& ref) { return vertices(ref).position[ref.border]; };
  auto exact = [&](const BorderRef& ref) { return vertices(ref).exact[ref.border]; };
  for (const SeamFace& f : faces) {
    if (parameters.exact) {
      AddFace(&result.digest, exact(f[0]), exact(f[1]), exact(f[2]));
    } else {
      AddFace(&result.digest, position(f[0]), position(f[1]), position(f[2]));
    }
  }
  return result;
}

}  // namespace folprom
