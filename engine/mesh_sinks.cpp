#include "engine/mesh_sinks.h"

#include <algorithm>

#include "engine/mesh/digest.h"

namespace folprom {
namespace {

constexpr uint64_t kOutside = ~uint64_t{0};
constexpr size_t kFacesPerWrite = 65536;

/// Entry `subtree` of a table that grows as subtrees arrive.
template <class T>
std::vector<T>& EntryFor(std::vector<std::vector<T>>& table, uint32_t subtree) {
  if (subtree >= table.size()) table.resize(subtree + size_t{1});
  return table[subtree];
}

/// Adds vertices and faces to the digest, and the positions of the border sets to *border.
template <class Position>
void AddPart(std::span<const Position> positions, const SubtreePart& part, io::MeshDigest* digest,
             std::vector<std::vector<Position>>* border) {
  AddVertices(digest, positions, part.attributes);
  for (const Face& f : part.faces) {
    AddFace(digest, positions[f[0]], positions[f[1]], positions[f[2]]);
  }
  auto& entry = EntryFor(*border, part.subtree);
  for (uint32_t vertex : part.border_vertices) entry.push_back(positions[vertex]);
}

template <class Position>
void AddSeamFaces(std::span<const SeamFace> faces, const std::vector<std::vector<Position>>& border,
                  io::MeshDigest* digest) {
  auto at = [&](const BorderRef& ref) { return border[ref.subtree][ref.border]; };
  for (const SeamFace& f : faces) AddFace(digest, at(f[0]), at(f[1]), at(f[2]));
}

[[noreturn]] void ThrowCountsDiffer(const std::string& input) {
  throw Failure(ErrorKind::kCorrupt, input + ": decoded counts differ from those of the table");
}

}  // namespace

void FileSink::AddSubtree(const SubtreePart& part) {
  if (part.positions.size() > expected_.vertices - vertices_) ThrowCountsDiffer(input_);
  xyz_.clear();
  xyz_.reserve(part.positions.size() * 3);
  for (size_t v = 0; v < part.positions.size(); ++v) {
    const ExactPosition xyz = part.Position(lattice_, v);
    xyz_.insert(xyz_.end(), xyz.begin(), xyz.end());
  }
  writer_.AppendVertices(xyz_, part.attributes).value();
  auto& border = EntryFor(border_, part.subtree);
  for (uint32_t vertex : part.border_vertices) border.push_back(vertices_ + vertex);
  for (const Face& f : part.faces) {
    triangles_.push_back({vertices_ + f[0], vertices_ + f[1], vertices_ + f[2]});
    if (triangles_.size() == kFacesPerWrite) Flush();
  }
  Flush();
  vertices_ += part.positions.size();
}

void FileSink::AddSeam(std::span<const SeamFace> faces) {
  for (const SeamFace& f : faces) {
    io::Triangle triangle;
    for (size_t i = 0; i < 3; ++i) triangle[i] = border_[f[i].subtree][f[i].border];
    triangles_.push_back(triangle);
  }
  Flush();
}

void FileSink::Flush() {
  if (triangles_.size() > expected_.faces - faces_) ThrowCountsDiffer(input_);
  writer_.AppendFaces(triangles_).value();
  faces_ += triangles_.size();
  triangles_.clear();
}

void FileSink::CheckComplete() const {
  if (vertices_ != expected_.vertices || faces_ != expected_.faces) ThrowCountsDiffer(input_);
}

void SoupSink::AddSubtree(const SubtreePart& part) {
  vertices_ += part.positions.size();
  auto& border = EntryFor(border_, part.subtree);
  for (const uint32_t vertex : part.border_vertices) {
    border.push_back(part.Position(lattice_, vertex));
  }
  for (const Face& face : part.faces) {
    for (const uint32_t vertex : face) AddCorner(part.Position(lattice_, vertex));
    if (xyz_.size() >= 9 * kFacesPerWrite) Flush();
  }
  Flush();
}

void SoupSink::AddSeam(std::span<const SeamFace> faces) {
  for (const SeamFace& face : faces) {
    for (const BorderRef& ref : face) AddCorner(border_[ref.subtree][ref.border]);
  }
  Flush();
}

void SoupSink::Flush() {
  const size_t count = xyz_.size() / 9;
  if (count > expected_.faces - faces_) ThrowCountsDiffer(input_);
  writer_.AppendVertices(xyz_).value();
  writer_.AppendFaces(SoupFaces(faces_, count)).value();
  faces_ += count;
  xyz_.clear();
}

void SoupSink::CheckComplete() const {
  if (vertices_ != expected_.vertices || faces_ != expected_.faces) ThrowCountsDiffer(input_);
}

std::vector<io::Triangle> SoupFaces(uint64_t first, size_t count) {
  std::vector<io::Triangle> faces(count);
  for (size_t i = 0; i < count; ++i) {
    const uint64_t vertex = 3 * (first + i);
    faces[i] = {vertex, vertex + 1, vertex + 2};
  }
  return faces;
}

RegionSink::RegionSink(const Lattice& lattice, std::array<double, 3> lo, std::array<double, 3> hi,
                       size_t attribute_bytes, const io::SpillDirectory& spill)
    : lattice_(lattice),
      lo_(lo),
      hi_(hi),
      attribute_bytes_(attribute_bytes),
      streams_(spill, "region", 3, uint64_t{1} << 20) {}

void RegionSink::AddSubtree(const SubtreePart& part) {
  index_.assign(part.positions.size(), kOutside);
  for (size_t v = 0; v < part.positions.size(); ++v) {
    const ExactPosition xyz = part.Position(lattice_, v);
    bool inside = true;
    for (size_t i = 0; i < 3; ++i) inside &= xyz[i] >= lo_[i] && xyz[i] <= hi_[i];
    if (!inside) continue;
    index_[v] = vertices_++;
    streams_.AppendValue(0, xyz);
    if (attribute_bytes_ == 0) continue;
    const auto values = part.attributes.subspan(v * attribute_bytes_, attribute_bytes_);
    streams_.Append(2, values.data(), values.size());
  }
  auto& border = EntryFor(border_, part.subtree);
  for (uint32_t vertex : part.border_vertices) border.push_back(index_[vertex]);
  for (const Face& f : part.faces) Keep({index_[f[0]], index_[f[1]], index_[f[2]]});
}

bool RegionSink::WantsFacesAcross(uint32_t subtree) const {
  if (subtree >= border_.size()) return false;
  const auto& border = border_[subtree];
  return std::any_of(border.begin(), border.end(),
                     [](uint64_t vertex) { return vertex != kOutside; });
}

void RegionSink::AddSeam(std::span<const SeamFace> faces) {
  for (const SeamFace& f : faces) {
    Keep({border_[f[0].subtree][f[0].border], border_[f[1].subtree][f[1].border],
          border_[f[2].subtree][f[2].border]});
  }
}

void RegionSink::Keep(const io::Triangle& face) {
  for (uint64_t vertex : face) {
    if (vertex == kOutside) return;
  }
  streams_.AppendValue(1, face);
  ++faces_;
}

void RegionSink::WriteTo(io::MeshWriter& writer) {
  streams_.Finish();
  io::MappedFile positions = streams_.Map(0), faces = streams_.Map(1), others = streams_.Map(2);
  std::span<const double> xyz = io::MappedArray<double>(positions);
  std::span<const io::Triangle> triangles = io::MappedArray<io::Triangle>(faces);
  constexpr size_t kStep = 65536;
  for (size_t begin = 0; begin < vertices_; begin += kStep) {
    const size_t count = std::min<size_t>(kStep, vertices_ - begin);
    const auto attributes =
        others.bytes().subspan(begin * attribute_bytes_, count * attribute_bytes_);
    writer.AppendVertices(xyz.subspan(3 * begin, 3 * count), attributes).value();
  }
  for (size_t i = 0; i < triangles.size(); i += kFacesPerWrite) {
    writer.AppendFaces(triangles.subspan(i, std::min(kFacesPerWrite, triangles.size() - i)))
        .value();
  }
}

void DigestSink::AddSubtree(const SubtreePart& part) {
  if (lattice_.exact) {
    std::vector<ExactPosition> exact(part.positions.size());
    for (size_t v = 0; v < exact.size(); ++v) exact[v] = part.Position(lattice_, v);
    AddPart<ExactPosition>(exact, part, &digest_, &exact_border_);
  } else {
    AddPart(part.positions, part, &digest_, &border_);
  }
  vertices_ += part.positions.size();
  faces_ += part.faces.size();
}

void DigestSink::AddSeam(std::span<const SeamFace> faces) {
  if (lattice_.exact) {
    AddSeamFaces(faces, exact_border_, &digest_);
  } else {
    AddSeamFaces(faces, border_, &digest_);
  }
  faces_ += faces.size();
}

}  // namespace folprom
