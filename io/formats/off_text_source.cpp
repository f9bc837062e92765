#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/formats/indexed_source.h"
#include "io/formats/off_colours.h"
#include "io/formats/off_source.h"
#include "io/formats/polygon_fan.h"
#include "io/formats/resident_window.h"
#include "io/formats/text_cursor.h"
#include "io/formats/text_number.h"
#include "io/result_of.h"

namespace folprom::io {
namespace {

/// A block of faces begins at a line.
struct OffFaceBlock {
  FilePosition position;
  uint64_t triangles = 0;
};

/// The words that are left of a line. A colour, with what a vertex may have beside it, has no more
/// than are kept.
class LineWords {
 public:
  static constexpr size_t kMost = 16;

  /// Takes all of them, and keeps those behind the first `skipped` ones.
  LineWords(uint64_t skipped, TextCursor& cursor) {
    for (std::string_view word; !(word = cursor.Word()).empty(); ++count_) {
      if (count_ >= skipped && kept_ < kMost) words_[kept_++] = word;
    }
  }
  /// Of all.
  uint64_t count() const { return count_; }
  std::span<const std::string_view> kept() const { return std::span(words_).first(kept_); }
  /// The kept ones, which were found to be numbers.
  std::span<const double> Reals(std::array<double, kMost>* to) const {
    to->fill(0);
    for (size_t i = 0; i < kept_; ++i) ParseReal(words_[i], &(*to)[i]);
    return std::span(*to).first(kept_);
  }

 private:
  std::array<std::string_view, kMost> words_;
  size_t kept_ = 0;
  uint64_t count_ = 0;
};

/// A line a vertex, then a line a face, and nothing more.
class OffIndexer {
 public:
  OffIndexer(const MappedFile& file, const OffHeader& header)
      : file_(file), header_(header), cursor_(file, header.body), window_(file) {}

  void Index() {
    CheckCounts();
    for (uint64_t i = 0; i < header_.vertices; ++i) WalkVertex(i);
    for (uint64_t i = 0; i < header_.faces; ++i) WalkFace(i);
    if (cursor_.NextWordLine()) cursor_.Fail("there are more lines than the header announces");
    index_.vertices = header_.vertices;
    index_.triangle_blocks = faces_.size();
    index_.coordinate_type = census_.type();
    index_.schema = OffVertexSchema(header_, vertex_colours_, others_.type());
    index_.face_schema = OffFaceSchema(face_colours_);
    if (!vertex_colours_.is_even()) {
      index_.notes.ignored_properties.push_back("colours of vertices");
    }
  }

  SourceIndex index_;
  std::vector<FilePosition> vertices_;
  std::vector<OffFaceBlock> faces_;
  ColourCensus vertex_colours_;

 private:
  // Before any step: a count may announce more than any file can hold.
  void CheckCounts() const {
    const uint64_t left = file_.bytes().size() - header_.body.offset + 1;
    const uint64_t most = left / 6;  // three digits and a blank each
    if (header_.vertices > most) {
      cursor_.Fail(std::to_string(header_.vertices) + " vertices are announced, but the bytes " +
                   "that are left hold at most " + std::to_string(most));
    }
    const uint64_t most_faces = (left - 6 * header_.vertices) / 2;
    if (header_.faces > most_faces) {
      cursor_.Fail(std::to_string(header_.faces) + " faces are announced, but the bytes " +
                   "that are left hold at most " + std::to_string(most_faces));
    }
  }

  void NextLine(const char* element, uint64_t index, uint64_t count) {
    if (!cursor_.NextWordLine()) {
      cursor_.Fail("the file ends before " + std::string(element) + " " + std::to_string(index) +
                   " of " + std::to_string(count));
    }
    window_.Advance(cursor_.position().offset);
  }

  void WalkVertex(uint64_t vertex) {
    NextLine("vertex", vertex, header_.vertices);
    if (vertex % kBlockVertices == 0) vertices_.push_back(cursor_.position());
    census_.AddPosition(cursor_);
    const LineWords line(0, cursor_);
    const uint64_t words = line.count();
    const uint64_t others = (header_.has_normals ? 3 : 0) + (header_.has_texture ? 2 : 0);
    // Many programs write colours without the C of the keyword.
    const bool has_colour = words == others + 3 || words == others + 4;
    if (!has_colour && (header_.has_colours || words != others)) {
      cursor_.Fail("a vertex has " + std::to_string(3 + words) + " values");
    }
    const size_t normals = header_.has_normals ? 3 : 0, colours = has_colour ? words - others : 0;
    vertex_colours_.Add(line.kept().subspan(normals, colours), cursor_);
    for (size_t i = 0; i < line.kept().size(); ++i) {
      if (i < normals || i >= normals + colours) others_.Add(line.kept()[i], cursor_);
    }
  }

  void WalkFace(uint64_t face) {
    NextLine("face", face, header_.faces);
    const FilePosition position = cursor_.position();
    const int64_t corners = cursor_.Integer("the number of corners");
    const LineWords line(static_cast<uint64_t>(std::max<int64_t>(corners, 0)), cursor_);
    const uint64_t words = line.count();
    if (corners < 0 || static_cast<uint64_t>(corners) > words) {
      cursor_.Fail("a face of " + std::to_string(corners) + " corners has " +
                   std::to_string(words) + " values behind their number");
    }
    // A colour is an index, or three or four values.
    const uint64_t more = words - static_cast<uint64_t>(corners);
    if (more == 2 || more > 4) {
      cursor_.Fail("a face of " + std::to_string(corners) + " corners has " + std::to_string(more) +
                   " values behind them, which is no colour");
    }
    const uint64_t triangles = FanTriangles(static_cast<uint64_t>(corners), index_.notes);
    if (triangles == 0) return;
    face_colours_.Add(line.kept(), cursor_);
    if (faces_.empty() || faces_.back().triangles + triangles > kBlockTriangles) {
      faces_.push_back({position, 0});
    }
    faces_.back().triangles += triangles;
    index_.triangles += triangles;
  }

  const MappedFile& file_;
  const OffHeader& header_;
  TextCursor cursor_;
  ResidentWindow window_;
  CoordinateCensus census_;
  CoordinateCensus others_;  ///< of normals and texture coordinates
  ColourCensus face_colours_;
};

class TextOffSource final : public IndexedSource {
 public:
  TextOffSource(MappedFile mapped, const OffHeader& header)
      : IndexedSource(std::move(mapped)), has_normals_(header.has_normals) {
    OffIndexer indexer(file(), header);
    indexer.Index();
    index_ = std::move(indexer.index_);
    vertices_ = std::move(indexer.vertices_);
    faces_ = std::move(indexer.faces_);
    keeps_colours_ = indexer.vertex_colours_.is_even();
    texture_ = header.has_texture ? kOffTexture.size() : 0;
  }

  Result<void> ReadVertexBlock(size_t block, std::vector<double>* xyz) const override {
    return ResultOf([&] {
      TextCursor cursor(file(), vertices_[block]);
      xyz->resize(3 * VerticesIn(block));
      for (size_t i = 0; i < xyz->size(); i += 3) {
        cursor.NextWordLine();
        for (size_t axis = 0; axis < 3; ++axis) {
          (*xyz)[i + axis] = cursor.Coordinate(index_.coordinate_type);
        }
        cursor.SkipSingleLine();
      }
    });
  }

  Result<void> ReadVertexAttributes(size_t block, std::vector<uint8_t>* values) const override {
    values->clear();
    if (index_.schema.attributes.empty()) return {};
    return ResultOf([&] {
      TextCursor cursor(file(), vertices_[block]);
      values->resize(VerticesIn(block) * index_.schema.Stride());
      uint8_t* to = values->data();
      for (uint64_t i = VerticesIn(block); i > 0; --i) {
        cursor.NextWordLine();
        to = ReadVertex(cursor, to);
      }
    });
  }

  Result<void> ReadFaceAttributes(size_t block, std::vector<uint8_t>* rows) const override {
    rows->clear();
    if (index_.face_schema.empty()) return {};
    return ResultOf([&] {
      TextCursor cursor(file(), faces_[block].position);
      const size_t bytes = faces_[block].triangles * index_.face_schema.RowBytes();
      std::array<double, LineWords::kMost> reals;
      while (rows->size() < bytes) {
        if (!cursor.NextWordLine()) cursor.Fail("the file has changed while it was read");
        const int64_t corners = cursor.Integer("the number of corners");
        if (corners >= 3) {
          const auto count = static_cast<uint64_t>(corners);
          AddOffRows(index_.face_schema, LineWords(count, cursor).Reals(&reals), count - 2, rows);
        }
        cursor.SkipSingleLine();
      }
    });
  }

 private:
  /// The attributes of a line, stored; where they go on.
  uint8_t* ReadVertex(TextCursor& cursor, uint8_t* to) const {
    std::array<double, LineWords::kMost> reals;
    const std::span<const double> values = LineWords(3, cursor).Reals(&reals);
    const size_t normals = has_normals_ ? kOffNormals.size() : 0;
    if (values.size() < normals + texture_) cursor.Fail("the file has changed while it was read");
    const size_t colours =
        keeps_colours_ ? index_.schema.attributes.size() - normals - texture_ : 0;
    const auto type = [&](size_t column) { return index_.schema.attributes[column].type; };
    if (normals > 0) to = StoreOffValues(values.first(normals), type(0), normals, to);
    if (colours > 0) {
      const auto some = values.subspan(normals, values.size() - normals - texture_);
      to = StoreOffValues(some, type(normals), colours, to);
    }
    if (texture_ > 0) {
      to = StoreOffValues(values.last(texture_), type(normals + colours), texture_, to);
    }
    return to;
  }

  Result<void> ReadFaces(size_t block, std::vector<Triangle>* triangles,
                         std::vector<uint8_t>* joins) const override {
    return ResultOf([&] {
      TextCursor cursor(file(), faces_[block].position);
      triangles->clear();
      triangles->reserve(faces_[block].triangles);
      while (triangles->size() < faces_[block].triangles) {
        cursor.NextWordLine();
        ReadFace(cursor, *triangles, joins);
        cursor.SkipSingleLine();
      }
    });
  }

  void ReadFace(TextCursor& cursor, std::vector<Triangle>& out, std::vector<uint8_t>* joins) const {
    const int64_t corners = cursor.Integer("the number of corners");
    if (corners < 3) return;  // dropped, as the walk noted
    PolygonFan fan(out, joins);
    for (int64_t i = 0; i < corners; ++i) {
      const int64_t vertex = cursor.Integer("the last corner");
      // A negative index is a huge one.
      if (static_cast<uint64_t>(vertex) >= index_.vertices) {
        cursor.Fail("the vertex index " + std::to_string(vertex) + " is not below the count of " +
                    std::to_string(index_.vertices) + " vertices");
      }
      fan.AddCorner(static_cast<uint64_t>(vertex));
    }
  }

  std::vector<FilePosition> vertices_;
  std::vector<OffFaceBlock> faces_;
  bool has_normals_, keeps_colours_ = true;
  size_t texture_ = 0;  ///< numbers
};

}  // namespace

std::unique_ptr<MeshSource> OpenTextOffSource(MappedFile file, const OffHeader& header) {
  return std::make_unique<TextOffSource>(std::move(file), header);
}

}  // namespace folprom::io
