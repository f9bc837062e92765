#include <deque>
#include <new>
#include <numeric>
#include <optional>
#include <utility>

#include "engine/codec/layer_reader.h"
#include "engine/mesh/lattice.h"
#include "engine/section_decoder.h"
#include "folprom/decoder.h"
#include "io/container/reader.h"
#include "io/formats/mesh_source.h"

namespace folprom {

namespace {

/// The attributes of a subtree's vertices behind those of the subtrees before it.
void AppendAttributes(const std::vector<uint8_t>& rows, const io::VertexSchema& schema,
                      std::vector<DecodedAttribute>* attributes) {
  const size_t stride = schema.Stride();
  size_t offset = 0;
  for (size_t a = 0; a < schema.attributes.size(); ++a) {
    const size_t size = ScalarSize(schema.attributes[a].type);
    std::vector<uint8_t>& values = (*attributes)[a].values;
    for (size_t i = offset; i < rows.size(); i += stride) {
      values.insert(values.end(), &rows[i], &rows[i] + size);
    }
    offset += size;
  }
}

/// The columns of rows.
std::vector<DecodedFaceAttribute> FaceAttributesOf(const io::FaceSchema& schema,
                                                   std::span<const uint8_t> rows) {
  std::vector<DecodedFaceAttribute> attributes;
  size_t of_face = 0, of_corner = schema.FaceBytes();
  for (const io::FaceAttribute& attribute : schema.attributes) {
    auto& values = attributes
                       .emplace_back(DecodedFaceAttribute{
                           attribute.name, attribute.type, attribute.per_corner, {}})
                       .values;
    const bool is_of_corner = attribute.per_corner > 0;
    size_t& offset = is_of_corner ? of_corner : of_face;
    for (size_t row = 0; row < rows.size(); row += schema.RowBytes()) {
      for (size_t corner = 0; corner < (is_of_corner ? 3 : 1); ++corner) {
        const auto some =
            rows.subspan(row + offset + corner * schema.CornerBytes(), attribute.bytes());
        values.insert(values.end(), some.begin(), some.end());
      }
    }
    offset += attribute.bytes();
  }
  return attributes;
}

/// Models are made before a vertex is known, and the table may name a subtree in a few bytes.
void CheckModels(const io::FileTable& table, uint64_t memory_bytes) {
  constexpr uint64_t kSubtree = uint64_t{352} << 10, kSeam = uint64_t{20} << 10;
  const uint64_t per_subtree =
      kSubtree + table.schema.attributes.size() * AttributeCoder::kModelBytes;
  uint64_t bytes = table.subtrees.size() * per_subtree;
  for (const io::SubtreeRecord& subtree : table.subtrees) {
    if (!subtree.lower_neighbours.empty()) bytes += kSeam;
  }
  if (bytes <= memory_bytes) return;
  throw Failure(ErrorKind::kLimit,
                "memory: the models of " + std::to_string(table.subtrees.size()) +
                    " subtrees take " + std::to_string(bytes >> 20) +
                    " MiB, more than the limit of " + std::to_string(memory_bytes >> 20) + " MiB");
}

/// A mesh as its sections have it.
struct ScanOrder {
  /// At each place the number of the vertex as it was decoded; of a soup none.
  std::vector<uint32_t> vertices;
  std::vector<Face> faces;  ///< of these places; of a soup of these numbers
  std::vector<uint64_t> polygon_begin;
  std::vector<uint8_t> rows;  ///< of the triangles: io::FaceSchema
};

/// Elements of `size` bytes in the order of the scan.
void Reorder(const std::vector<uint32_t>& vertices, size_t size, std::vector<uint8_t>* values) {
  std::vector<uint8_t> ordered;
  ordered.reserve(values->size());
  for (const size_t vertex : vertices) {
    const auto begin = values->begin() + static_cast<std::ptrdiff_t>(vertex * size);
    ordered.insert(ordered.end(), begin, begin + static_cast<std::ptrdiff_t>(size));
  }
  *values = std::move(ordered);
}

/// Gives each face three vertices of its own.
void MakeSoup(DecodedMesh* mesh) {
  std::vector<std::array<double, 3>> positions;
  positions.reserve(3 * mesh->faces.size());
  for (std::array<uint64_t, 3>& face : mesh->faces) {
    for (uint64_t& corner : face) {
      positions.push_back(mesh->positions[corner]);
      corner = positions.size() - 1;
    }
  }
  mesh->positions = std::move(positions);
}

}  // namespace

struct MemoryDecoder::Impl {
  /// most_bytes: what the models may take, and what faces have.
  Impl(io::ContainerReader opened, uint64_t most_bytes)
      : memory_bytes(most_bytes),
        container(std::move(opened)),
        parameters(ParametersOf(container.table(), container.layers_total())) {
    const io::FileTable& table = container.table();
    CheckModels(table, memory_bytes);
    std::vector<bool> border = SubtreesWithBorder(table);
    for (size_t s = 0; s < table.subtrees.size(); ++s) {
      subtrees.emplace_back(container, parameters, s, border[s]);
    }
    for (size_t s = 0; s < table.subtrees.size(); ++s) {
      const auto& lower = table.subtrees[s].lower_neighbours;
      if (lower.empty()) continue;
      std::vector<SeamCoder::Participant> members;
      for (uint32_t member : lower) members.push_back({member, &subtrees[member].state().border()});
      members.push_back({static_cast<uint32_t>(s), &subtrees[s].state().border()});
      seams.emplace_back(container, parameters, s, std::move(members));
    }
  }

  void CheckCounts() const {
    uint64_t vertices = 0, faces = 0;
    for (const SubtreeReader& subtree : subtrees) {
      vertices += subtree.state().positions().size();
      faces += subtree.state().face_count();
    }
    for (const SeamReader& seam : seams) faces += seam.state().face_count();
    const io::LayerRecord& layer = container.table().layers[decoded];
    if (vertices != layer.vertices || faces != layer.faces) {
      throw Failure(ErrorKind::kCorrupt,
                    container.name() + ": decoded counts differ from those of the table");
    }
  }

  /// The rows of the faces, and what their coder keeps.
  void CheckFaceValues() const {
    const io::FileTable& table = container.table();
    const io::FaceSchema& schema = table.face_schema;
    if (schema.empty()) return;
    const uint64_t bytes = table.faces * schema.RowBytes() +
                           table.vertices * FaceValueCoder::VertexBytes(schema) +
                           schema.Columns() * FaceValueCoder::kModelBytes;
    if (bytes <= memory_bytes) return;
    throw Failure(ErrorKind::kLimit, "memory: the attributes of faces take " +
                                         std::to_string(bytes >> 20) +
                                         " MiB, more than the limit of " +
                                         std::to_string(memory_bytes >> 20) + " MiB");
  }

  /// Where the file tells how the scan stood in its own, and all of it is there.
  void DecodeSections() {
    if (!HasWholeSections(container)) return;
    const io::FileTable& table = container.table();
    CheckOrderable(table.vertices, table.faces, container.name());
    CheckFaceValues();
    std::vector<uint32_t> number_of;  // along the curve, of each vertex as it was decoded
    for (const SubtreeReader& subtree : subtrees) {
      const auto& positions = subtree.state().positions();
      std::vector<uint32_t> numbers(positions.size());
      std::iota(numbers.begin(), numbers.end(), 0u);
      const auto base = static_cast<uint32_t>(number_of.size());
      for (const uint32_t place : CurvePlaces(positions, numbers)) {
        number_of.push_back(base + place);
      }
    }
    std::vector<Int3> positions(number_of.size());
    std::vector<uint32_t> vertex_of(number_of.size());
    size_t vertex = 0;
    for (const SubtreeReader& subtree : subtrees) {
      for (const Int3& position : subtree.state().positions()) {
        positions[number_of[vertex]] = position;
        vertex_of[number_of[vertex]] = static_cast<uint32_t>(vertex);
        ++vertex;
      }
    }
    std::vector<Face> faces;
    for (const std::array<uint64_t, 3>& f : Faces()) {
      faces.push_back({number_of[f[0]], number_of[f[1]], number_of[f[2]]});
    }
    HeapSpace space;
    SectionDecoder decoder(container, positions, faces, space);
    ScanOrder result;
    for (const uint32_t number : decoder.sequence()) {
      if (!table.is_soup) result.vertices.push_back(vertex_of[number]);
    }
    FaceChunk chunk;
    while (decoder.Next(&chunk)) {
      for (Face& face : chunk.triangles) {
        for (uint32_t& corner : face) corner = table.is_soup ? vertex_of[corner] : corner;
      }
      for (size_t i = 0; i < chunk.joins.size(); ++i) {
        if (chunk.joins[i] == 0) result.polygon_begin.push_back(result.faces.size() + i);
      }
      result.faces.insert(result.faces.end(), chunk.triangles.begin(), chunk.triangles.end());
      result.rows.insert(result.rows.end(), chunk.rows.begin(), chunk.rows.end());
    }
    order = std::move(result);
  }

  /// Of the vertices as they were decoded, subtree by subtree.
  std::vector<std::array<uint64_t, 3>> Faces() const {
    std::vector<std::array<uint64_t, 3>> all;
    std::vector<uint64_t> base;
    std::vector<std::vector<uint32_t>> border;
    std::vector<Face> faces;
    uint64_t first = 0;
    for (const SubtreeReader& subtree : subtrees) {
      base.push_back(first);
      border.push_back(subtree.state().BorderVertices());
      faces.clear();
      subtree.state().AppendFaces(&faces);
      for (const Face& f : faces) all.push_back({first + f[0], first + f[1], first + f[2]});
      first += subtree.state().positions().size();
    }
    std::vector<SeamFace> cross;
    for (const SeamReader& seam : seams) seam.state().AppendFaces(&cross);
    auto index = [&](const BorderRef& ref) {
      return base[ref.subtree] + border[ref.subtree][ref.border];
    };
    for (const SeamFace& f : cross) all.push_back({index(f[0]), index(f[1]), index(f[2])});
    return all;
  }

  uint64_t memory_bytes;
  io::ContainerReader container;
  CodecParameters parameters;
  std::deque<SubtreeReader> subtrees;  // addresses stay: seams point into them
  std::deque<SeamReader> seams;
  size_t decoded = 0;
  std::optional<ScanOrder> order;
};

MemoryDecoder::MemoryDecoder(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
MemoryDecoder::MemoryDecoder(MemoryDecoder&&) noexcept = default;
MemoryDecoder& MemoryDecoder::operator=(MemoryDecoder&&) noexcept = default;
MemoryDecoder::~MemoryDecoder() = default;

Result<MemoryDecoder> MemoryDecoder::Open(std::span<const uint8_t> file, uint64_t memory_bytes) {
  if (memory_bytes == 0) memory_bytes = (uint64_t{56} << 20) + 56 * uint64_t{file.size()};
  try {
    auto container = io::ContainerReader::Open(file, "memory");
    return MemoryDecoder(std::make_unique<Impl>(std::move(container).value(), memory_bytes));
  } catch (const Failure& failure) {
    return failure.error();
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::kLimit, "out of memory"};
  }
}

size_t MemoryDecoder::layer_count() const { return impl_->container.layers_total(); }
size_t MemoryDecoder::complete_layers() const { return impl_->container.complete_layers(); }
size_t MemoryDecoder::decoded_layers() const { return impl_->decoded; }

double MemoryDecoder::error_bound() const {
  if (impl_->decoded == 0) return 0;
  return static_cast<double>(impl_->container.table().layers[impl_->decoded - 1].error_bound);
}

Result<void> MemoryDecoder::DecodeNextLayer() {
  try {
    if (impl_->decoded >= complete_layers()) {
      return Error{ErrorKind::kCorrupt, "no further complete layer in the file"};
    }
    for (SubtreeReader& subtree : impl_->subtrees) subtree.DecodeLayer();
    for (SeamReader& seam : impl_->seams) seam.DecodeLayer();
    impl_->CheckCounts();
    ++impl_->decoded;
    if (impl_->decoded == layer_count()) impl_->DecodeSections();
    return {};
  } catch (const Failure& failure) {
    return failure.error();
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::kLimit, "out of memory"};
  }
}

DecodedMesh MemoryDecoder::Mesh() const {
  const io::FileTable& table = impl_->container.table();
  const Lattice lattice = LatticeOf(table, impl_->parameters);
  const double bound = error_bound();
  DecodedMesh mesh;
  mesh.is_float = static_cast<ScalarType>(table.coordinate_type) == ScalarType::kFloat32;
  for (const io::VertexAttribute& attribute : table.schema.attributes) {
    mesh.attributes.push_back({attribute.name, attribute.type, {}});
  }
  for (const SubtreeReader& subtree : impl_->subtrees) {
    const std::vector<ExactPosition> exact = subtree.state().DrawnPositions(lattice, bound);
    mesh.positions.insert(mesh.positions.end(), exact.begin(), exact.end());
    for (const Int3& p : subtree.state().positions()) {
      if (exact.empty()) mesh.positions.push_back(lattice.ToModel(p));
    }
    AppendAttributes(subtree.state().Attributes(), table.schema, &mesh.attributes);
  }
  const bool is_soup = table.is_soup && impl_->decoded == layer_count();
  if (!impl_->order) {
    mesh.faces = impl_->Faces();
    if (is_soup) MakeSoup(&mesh);
    return mesh;
  }
  const ScanOrder& order = *impl_->order;
  for (const Face& f : order.faces) mesh.faces.push_back({f[0], f[1], f[2]});
  mesh.has_scan_order = table.Section(io::SectionKind::kOrder).has_value();
  if (is_soup) {
    MakeSoup(&mesh);
    return mesh;
  }
  std::vector<std::array<double, 3>> positions;
  positions.reserve(order.vertices.size());
  for (const size_t vertex : order.vertices) positions.push_back(mesh.positions[vertex]);
  mesh.positions = std::move(positions);
  for (DecodedAttribute& attribute : mesh.attributes) {
    Reorder(order.vertices, ScalarSize(attribute.type), &attribute.values);
  }
  mesh.polygon_begin = order.polygon_begin;
  mesh.face_attributes = FaceAttributesOf(table.face_schema, order.rows);
  return mesh;
}

}  // namespace folprom
