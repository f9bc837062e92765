#include "engine/section_decoder.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace folprom {
namespace {

std::string PlaceOf(const io::ContainerReader& container, io::SectionKind kind) {
  constexpr std::array<const char*, io::kSectionKinds> kNames = {"order", "polygons",
                                                                 "attributes of faces"};
  return container.name() + ": " + kNames[static_cast<size_t>(kind)] + ": ";
}

io::BlockReader BlocksOf(const io::ContainerReader& container, io::SectionKind kind) {
  const bool is_there = container.table().Section(kind).has_value();
  return {is_there ? container.Section(kind) : std::span<const uint8_t>(),
          PlaceOf(container, kind)};
}

}  // namespace

bool HasWholeSections(const io::ContainerReader& container) {
  const io::FileTable& table = container.table();
  for (size_t i = 0; i < io::kSectionKinds; ++i) {
    const auto kind = static_cast<io::SectionKind>(i);
    if (table.Section(kind) && !container.HasSection(kind)) return false;
  }
  return table.HasSections();
}

/// Messages of the coders do not know where they are.
template <class Work>
auto SectionDecoder::InSection(io::SectionKind kind, Work work) {
  try {
    return work();
  } catch (const Failure& failure) {
    const std::string place = PlaceOf(container_, kind);
    if (failure.error().message.starts_with(place)) throw;
    throw Failure(failure.error().kind, place + failure.error().message);
  }
}

SectionDecoder::SectionDecoder(const io::ContainerReader& container,
                               std::span<const Int3> positions, std::span<const Face> faces,
                               WorkSpace& space)
    : container_(container),
      mesh_(MakeOrderMesh(positions, faces, space)),
      sequence_(space.Words(positions.size())),
      place_of_(space.Words(positions.size())),
      order_(mesh_, sequence_, place_of_, container.table().is_soup, space),
      order_blocks_(BlocksOf(container, io::SectionKind::kOrder)),
      polygon_blocks_(BlocksOf(container, io::SectionKind::kPolygons)),
      value_blocks_(BlocksOf(container, io::SectionKind::kFaceValues)),
      value_digest_(container.table().face_schema) {
  const io::FileTable& table = container.table();
  if (table.Section(io::SectionKind::kFaceValues)) {
    values_.emplace(mesh_, table.face_schema, table.face_ranges, space);
  }
  if (!table.Section(io::SectionKind::kOrder)) {
    std::iota(sequence_.begin(), sequence_.end(), 0u);
    if (table.Section(io::SectionKind::kPolygons)) set_.emplace(mesh_, nullptr, space);
    return;
  }
  InSection(io::SectionKind::kOrder, [&] {
    while (order_.NextVertices() > 0) {
      order_bits_.StartSegment(order_blocks_.Next());
      order_.CodeVertices(order_bits_);
      order_bits_.FinishSegment();
    }
  });
}

bool SectionDecoder::Next(FaceChunk* chunk) {
  chunk->triangles.clear();
  chunk->joins.clear();
  chunk->rows.clear();
  if (set_) {
    ReadSet(chunk);
  } else if (container_.table().Section(io::SectionKind::kOrder)) {
    ReadOrder(chunk);
  } else {
    ReadNumbers(chunk);
  }
  if (chunk->triangles.empty()) {
    CheckEnd();
    return false;
  }
  for (size_t i = 0; i < chunk->joins.size(); ++i) {
    digest_.Add(chunk->triangles[i], chunk->joins[i] != 0);
  }
  const size_t row_bytes = container_.table().face_schema.RowBytes();
  for (size_t i = 0; i * row_bytes < chunk->rows.size(); ++i) {
    value_digest_.Add(chunk->triangles[i], !chunk->joins.empty() && chunk->joins[i] != 0,
                      std::span(chunk->rows).subspan(i * row_bytes, row_bytes));
  }
  return true;
}

void SectionDecoder::ReadOrder(FaceChunk* chunk) {
  const uint32_t count = order_.NextFaces();
  if (count == 0) return;
  chunk->triangles.resize(count);
  InSection(io::SectionKind::kOrder, [&] {
    order_bits_.StartSegment(order_blocks_.Next());
    order_.CodeFaces(order_bits_, chunk->triangles);
    order_bits_.FinishSegment();
  });
  if (container_.table().is_soup) return;
  if (container_.table().Section(io::SectionKind::kPolygons)) {
    chunk->joins.resize(count);
    InSection(io::SectionKind::kPolygons, [&] {
      polygon_bits_.StartSegment(polygon_blocks_.Next());
      joins_.Code(polygon_bits_, chunk->triangles, chunk->joins);
      polygon_bits_.FinishSegment();
    });
  }
  ReadValues(chunk);
  for (Face& face : chunk->triangles) {
    for (uint32_t& corner : face) corner = place_of_[corner];
  }
}

void SectionDecoder::ReadSet(FaceChunk* chunk) {
  if (set_->AtEnd()) return;
  InSection(io::SectionKind::kPolygons, [&] {
    polygon_bits_.StartSegment(polygon_blocks_.Next());
    set_->Code(polygon_bits_, kOrderBlock, &chunk->triangles, &chunk->joins);
    polygon_bits_.FinishSegment();
  });
  ReadValues(chunk);
}

void SectionDecoder::ReadNumbers(FaceChunk* chunk) {
  const uint32_t count = std::min(kOrderBlock, mesh_.face_count() - numbers_done_);
  if (count == 0) return;
  const auto faces = mesh_.faces.subspan(numbers_done_, count);
  chunk->triangles.assign(faces.begin(), faces.end());
  numbers_done_ += count;
  ReadValues(chunk);
}

void SectionDecoder::ReadValues(FaceChunk* chunk) {
  if (!values_) return;
  chunk->rows.resize(chunk->triangles.size() * container_.table().face_schema.RowBytes());
  InSection(io::SectionKind::kFaceValues, [&] {
    value_bits_.StartSegment(value_blocks_.Next());
    values_->Code(value_bits_, chunk->triangles, chunk->joins, chunk->rows);
    value_bits_.FinishSegment();
  });
}

void SectionDecoder::CheckEnd() {
  const io::FileTable& table = container_.table();
  const auto check = [&](io::SectionKind kind, io::BlockReader& blocks, uint64_t digest) {
    const auto& section = table.Section(kind);
    if (!section) return;
    if (!blocks.AtEnd()) blocks.Fail("longer than its content");
    if (digest != section->digest) blocks.Fail("what was decoded differs from the digest");
  };
  digest_.Close();
  value_digest_.Close();
  check(io::SectionKind::kOrder, order_blocks_, order_.digest());
  check(io::SectionKind::kPolygons, polygon_blocks_, digest_.digest());
  check(io::SectionKind::kFaceValues, value_blocks_, value_digest_.digest());
  const bool has_polygons = table.Section(io::SectionKind::kPolygons).has_value();
  const uint64_t polygons = has_polygons ? digest_.polygons() : table.faces;
  const uint64_t largest =
      has_polygons ? digest_.largest() : std::min<uint64_t>(table.faces, 1) * 3;
  if (polygons != table.polygons || largest != table.largest_face) {
    throw Failure(ErrorKind::kCorrupt,
                  container_.name() + ": decoded faces differ in number from those of the table");
  }
}

}  // namespace folprom
