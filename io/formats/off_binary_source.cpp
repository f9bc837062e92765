#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "folprom/float_bits.h"
#include "io/formats/indexed_source.h"
#include "io/formats/off_colours.h"
#include "io/formats/off_source.h"
#include "io/formats/ply_scalar.h"
#include "io/formats/polygon_fan.h"
#include "io/formats/resident_window.h"
#include "io/formats/store_bytes.h"
#include "io/result_of.h"

namespace folprom::io {
namespace {

constexpr uint64_t kWord = 4;  // bytes of every value
constexpr uint64_t kCounts = 3 * kWord;

/// What Geomview specifies is big-endian, with the number of colour values behind each face. Other
/// programs write the order of their machine, no such number, and colours of three values.
struct OffBinaryForm {
  bool big_endian = true;
  bool face_colours = true;
  uint64_t vertex_colours = 0;  // values a vertex
};

struct OffBinaryBlock {
  uint64_t offset = 0;
  uint64_t triangles = 0;
};

struct OffBinaryIndex {
  SourceIndex source;
  OffBinaryForm form;
  uint64_t vertex_bytes = 0;
  std::vector<OffBinaryBlock> faces;
};

uint32_t Word(const uint8_t* bytes, bool big_endian) {
  return big_endian ? Load<uint32_t, true>(bytes) : Load<uint32_t, false>(bytes);
}

/// Walks the body as if it were of one form.
class OffBinaryWalk {
 public:
  OffBinaryWalk(const MappedFile& file, const OffHeader& header, const OffBinaryForm& form)
      : bytes_(file.bytes()), at_(header.body.offset), window_(file) {
    index_.form = form;
    index_.vertex_bytes = kWord * (3 + (header.has_normals ? 3 : 0) + form.vertex_colours +
                                   (header.has_texture ? 2 : 0));
  }

  /// None where the body is not of this form, which must end with the file.
  std::optional<OffBinaryIndex> Index() {
    if (Left() < kCounts) return std::nullopt;
    const uint64_t vertices = Next(), faces = Next();
    Next();  // edges
    if (vertices > Left() / index_.vertex_bytes) return std::nullopt;
    at_ += vertices * index_.vertex_bytes;
    if (faces > Left() / kWord) return std::nullopt;
    for (uint64_t i = 0; i < faces; ++i) {
      if (!WalkFace()) return std::nullopt;
    }
    if (Left() > 0) return std::nullopt;
    index_.source.vertices = vertices;
    index_.source.triangle_blocks = index_.faces.size();
    face_colours_.SetFloats();
    index_.source.face_schema = OffFaceSchema(face_colours_);
    return std::move(index_);
  }

 private:
  uint64_t Left() const { return bytes_.size() - at_; }
  uint64_t Next() {
    return Word(bytes_.data() + std::exchange(at_, at_ + kWord), index_.form.big_endian);
  }

  bool WalkFace() {
    const uint64_t begin = at_;
    window_.Advance(at_);
    if (Left() < kWord) return false;
    const uint64_t corners = Next();
    // No face has no corner; a number of no colours, taken for one, would have.
    if (corners == 0 || corners > Left() / kWord) return false;
    at_ += corners * kWord;
    uint64_t values = 0;
    if (index_.form.face_colours) {
      if (Left() < kWord) return false;
      values = Next();
      if (values > 4 || values > Left() / kWord) return false;
      at_ += values * kWord;
    }
    if (corners >= 3) face_colours_.AddCount(values);
    AddTriangles(FanTriangles(corners, index_.source.notes), begin);
    return true;
  }

  void AddTriangles(uint64_t triangles, uint64_t begin) {
    if (triangles == 0) return;
    if (index_.faces.empty() || index_.faces.back().triangles + triangles > kBlockTriangles) {
      index_.faces.push_back({begin, 0});
    }
    index_.faces.back().triangles += triangles;
    index_.source.triangles += triangles;
  }

  std::span<const uint8_t> bytes_;
  uint64_t at_;
  ResidentWindow window_;
  ColourCensus face_colours_;
  OffBinaryIndex index_;
};

OffBinaryIndex IndexBinaryOff(const MappedFile& file, const OffHeader& header) {
  std::vector<uint64_t> colours{0};
  if (header.has_colours) colours = {4, 3};
  for (const bool big_endian : {true, false}) {
    for (const bool face_colours : {true, false}) {
      for (const uint64_t vertex_colours : colours) {
        OffBinaryWalk walk(file, header, {big_endian, face_colours, vertex_colours});
        if (std::optional<OffBinaryIndex> index = walk.Index()) return std::move(*index);
      }
    }
  }
  throw Failure(ErrorKind::kInput,
                file.path() +
                    ": binary OFF: the vertices and faces that the counts announce do not end with "
                    "the file, in either byte order, with or without colours of faces");
}

class BinaryOffSource final : public IndexedSource {
 public:
  BinaryOffSource(MappedFile mapped, const OffHeader& header)
      : IndexedSource(std::move(mapped)), begin_(header.body.offset + kCounts) {
    OffBinaryIndex index = IndexBinaryOff(file(), header);
    index_ = std::move(index.source);
    form_ = index.form;
    vertex_bytes_ = index.vertex_bytes;
    faces_ = std::move(index.faces);
    ColourCensus colours;
    colours.SetFloats();
    colours.AddCount(form_.vertex_colours);
    index_.schema = OffVertexSchema(header, colours, ScalarType::kFloat32);
  }

  Result<void> ReadVertexBlock(size_t block, std::vector<double>* xyz) const override {
    xyz->resize(3 * VerticesIn(block));
    const uint8_t* vertex =
        file().bytes().data() + begin_ + vertex_block_begin(block) * vertex_bytes_;
    for (size_t i = 0; i < xyz->size(); i += 3, vertex += vertex_bytes_) {
      for (size_t axis = 0; axis < 3; ++axis) {
        (*xyz)[i + axis] =
            WidenFloat(std::bit_cast<float>(Word(vertex + kWord * axis, form_.big_endian)));
      }
    }
    return {};
  }

  /// All are floats, as many words as a vertex has behind its position.
  Result<void> ReadVertexAttributes(size_t block, std::vector<uint8_t>* values) const override {
    const size_t stride = index_.schema.Stride();
    values->resize(VerticesIn(block) * stride);
    if (values->empty()) return {};
    const uint8_t* vertex =
        file().bytes().data() + begin_ + vertex_block_begin(block) * vertex_bytes_;
    for (uint8_t* to = values->data(); to != values->data() + values->size();
         vertex += vertex_bytes_) {
      for (size_t at = 3 * kWord; at < vertex_bytes_; at += kWord) {
        to = StoreLittleEndian(Word(vertex + at, form_.big_endian), to);
      }
    }
    return {};
  }

  Result<void> ReadFaceAttributes(size_t block, std::vector<uint8_t>* rows) const override {
    rows->clear();
    if (index_.face_schema.empty()) return {};
    return ResultOf([&] {
      const uint8_t* at = file().bytes().data() + faces_[block].offset;
      const size_t bytes = faces_[block].triangles * index_.face_schema.RowBytes();
      std::vector<Triangle> triangles;
      std::vector<double> colours;
      while (rows->size() < bytes) {
        triangles.clear();
        at = ReadFace(at, triangles, nullptr, &colours);
        AddOffRows(index_.face_schema, colours, triangles.size(), rows);
      }
    });
  }

 private:
  Result<void> ReadFaces(size_t block, std::vector<Triangle>* triangles,
                         std::vector<uint8_t>* joins) const override {
    return ResultOf([&] {
      const uint8_t* at = file().bytes().data() + faces_[block].offset;
      triangles->clear();
      triangles->reserve(faces_[block].triangles);
      while (triangles->size() < faces_[block].triangles)
        at = ReadFace(at, *triangles, joins, nullptr);
    });
  }

  const uint8_t* ReadFace(const uint8_t* face, std::vector<Triangle>& out,
                          std::vector<uint8_t>* joins, std::vector<double>* colours) const {
    const uint8_t* at = face;
    const uint8_t* const end = file().bytes().data() + file().bytes().size();
    // The walk saw that all is there, unless the file has changed since.
    const auto check = [&](uint64_t words) {
      if (words > static_cast<uint64_t>(end - at) / kWord) {
        throw Failure(ErrorKind::kInput, path() + ": the file has changed while it was read");
      }
    };
    const auto next = [&] { return Word(std::exchange(at, at + kWord), form_.big_endian); };
    check(1);
    const uint64_t corners = next();
    check(corners);
    PolygonFan fan(out, joins);
    if (corners < 3) at += corners * kWord;  // dropped, as the walk noted
    for (uint64_t i = 0; corners >= 3 && i < corners; ++i) {
      const uint32_t vertex = next();
      if (vertex >= index_.vertices) ThrowNoVertex(face, vertex);
      fan.AddCorner(vertex);
    }
    if (form_.face_colours) {
      check(1);
      const uint64_t values = next();
      check(values);
      if (colours != nullptr) colours->clear();
      for (uint64_t i = 0; i < values; ++i) {
        const double value = WidenFloat(std::bit_cast<float>(next()));
        if (colours != nullptr) colours->push_back(value);
      }
    }
    return at;
  }

  [[noreturn]] void ThrowNoVertex(const uint8_t* face, uint32_t vertex) const {
    throw Failure(ErrorKind::kInput,
                  path() + ": the face at byte " + std::to_string(face - file().bytes().data()) +
                      ": the vertex index " + std::to_string(static_cast<int32_t>(vertex)) +
                      " is not below the count of " + std::to_string(index_.vertices) +
                      " vertices");
  }

  uint64_t begin_;  // offset of the first vertex
  OffBinaryForm form_;
  uint64_t vertex_bytes_ = 0;
  std::vector<OffBinaryBlock> faces_;
};

}  // namespace

std::unique_ptr<MeshSource> OpenBinaryOffSource(MappedFile file, const OffHeader& header) {
  return std::make_unique<BinaryOffSource>(std::move(file), header);
}

}  // namespace folprom::io
