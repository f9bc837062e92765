#include "engine/ordered_mesh.h"

#include <algorithm>
#include <numeric>

namespace folprom {
namespace {

template <class T>
std::span<const T> ArrayOf(std::span<const uint8_t> bytes) {
  return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
}

}  // namespace

OrderedMesh::OrderedMesh(const io::ContainerReader& container, const Lattice& lattice,
                         const io::SpillDirectory& spill, uint64_t memory_bytes)
    : container_(container),
      table_(container.table()),
      lattice_(lattice),
      space_(spill, "ordered", memory_bytes),
      stride_(table_.schema.Stride()),
      has_exact_(lattice.exact && lattice.exact->step.has_rests),
      streams_(spill, "collected", kStreams, uint64_t{kStreams} << 20) {
  CheckOrderable(table_.vertices, table_.faces, container.name());
  border_.resize(table_.subtrees.size());
}

void OrderedMesh::ThrowCountsDiffer() const {
  throw Failure(ErrorKind::kCorrupt,
                container_.name() + ": decoded counts differ from those of the table");
}

void OrderedMesh::AddSubtree(const SubtreePart& part) {
  const size_t count = part.positions.size();
  if (count > table_.vertices - vertices_) ThrowCountsDiffer();
  std::vector<uint32_t> numbers(count), vertex_at(count);
  std::iota(numbers.begin(), numbers.end(), 0u);
  numbers = CurvePlaces(part.positions, numbers);
  for (uint32_t v = 0; v < count; ++v) vertex_at[numbers[v]] = v;
  for (const uint32_t v : vertex_at) {
    streams_.AppendValue(kPositions, part.positions[v]);
    if (has_exact_) streams_.AppendValue(kExact, part.Position(lattice_, v));
    if (stride_ == 0) continue;
    const auto values = part.attributes.subspan(v * stride_, stride_);
    streams_.Append(kAttributes, values.data(), values.size());
  }
  for (uint32_t& number : numbers) number += static_cast<uint32_t>(vertices_);
  for (const Face& f : part.faces) AddFace({numbers[f[0]], numbers[f[1]], numbers[f[2]]});
  for (const uint32_t vertex : part.border_vertices) {
    border_[part.subtree].push_back(numbers[vertex]);
  }
  vertices_ += count;
}

void OrderedMesh::AddSeam(std::span<const SeamFace> faces) {
  const auto number = [&](const BorderRef& ref) { return border_[ref.subtree][ref.border]; };
  for (const SeamFace& f : faces) AddFace({number(f[0]), number(f[1]), number(f[2])});
}

void OrderedMesh::AddFace(const Face& face) {
  if (faces_added_++ == table_.faces) ThrowCountsDiffer();
  streams_.AppendValue(kFaces, face);
}

void OrderedMesh::Finish() {
  if (vertices_ != table_.vertices || faces_added_ != table_.faces) ThrowCountsDiffer();
  streams_.Finish();
  positions_ = ArrayOf<Int3>(space_.Adopt(streams_.Map(kPositions)));
  exact_ = ArrayOf<ExactPosition>(space_.Adopt(streams_.Map(kExact)));
  attributes_ = space_.Adopt(streams_.Map(kAttributes));
  decoder_.emplace(container_, positions_, ArrayOf<Face>(space_.Adopt(streams_.Map(kFaces))),
                   space_);
}

void OrderedMesh::AppendPosition(uint32_t number, std::vector<double>* xyz) {
  const ExactPosition p = has_exact_ ? exact_[number] : lattice_.ToModel(positions_[number]);
  xyz->insert(xyz->end(), p.begin(), p.end());
}

void OrderedMesh::ReadCorners(std::span<const Face> faces, std::vector<double>* xyz) {
  xyz->clear();
  for (const Face& face : faces) {
    for (const uint32_t number : face) AppendPosition(number, xyz);
    space_.Stepped(1);
  }
}

void OrderedMesh::ReadVertices(uint64_t first, size_t count, std::vector<double>* xyz,
                               std::vector<uint8_t>* attributes) {
  xyz->clear();
  attributes->clear();
  for (const uint32_t number : decoder_->sequence().subspan(first, count)) {
    AppendPosition(number, xyz);
    const auto values = attributes_.subspan(number * stride_, stride_);
    attributes->insert(attributes->end(), values.begin(), values.end());
    space_.Stepped(1);
  }
}

}  // namespace folprom
