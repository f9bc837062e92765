#include <deque>
#include <new>
#include <utility>

#include "engine/codec/layer_reader.h"
#include "engine/mesh/lattice.h"
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

}  // namespace

struct MemoryDecoder::Impl {
  /// memory_bytes: what the models may take.
  Impl(io::ContainerReader opened, uint64_t memory_bytes)
      : container(std::move(opened)),
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

  io::ContainerReader container;
  CodecParameters parameters;
  std::deque<SubtreeReader> subtrees;  // addresses stay: seams point into them
  std::deque<SeamReader> seams;
  size_t decoded = 0;
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
  std::vector<uint64_t> base;
  std::vector<std::vector<uint32_t>> border;
  std::vector<Face> faces;
  for (const SubtreeReader& subtree : impl_->subtrees) {
    base.push_back(mesh.positions.size());
    border.push_back(subtree.state().BorderVertices());
    const std::vector<ExactPosition> exact = subtree.state().DrawnPositions(lattice, bound);
    mesh.positions.insert(mesh.positions.end(), exact.begin(), exact.end());
    for (const Int3& p : subtree.state().positions()) {
      if (exact.empty()) mesh.positions.push_back(lattice.ToModel(p));
    }
    AppendAttributes(subtree.state().Attributes(), table.schema, &mesh.attributes);
    faces.clear();
    subtree.state().AppendFaces(&faces);
    for (const Face& f : faces) {
      mesh.faces.push_back({base.back() + f[0], base.back() + f[1], base.back() + f[2]});
    }
  }
  std::vector<SeamFace> cross;
  for (const SeamReader& seam : impl_->seams) seam.state().AppendFaces(&cross);
  auto index = [&](const BorderRef& ref) {
    return base[ref.subtree] + border[ref.subtree][ref.border];
  };
  for (const SeamFace& f : cross) mesh.faces.push_back({index(f[0]), index(f[1]), index(f[2])});
  return mesh;
}

}  // namespace folprom
