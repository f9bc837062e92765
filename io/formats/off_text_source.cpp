#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "io/formats/indexed_source.h"
#include "io/formats/off_source.h"
#include "io/formats/polygon_fan.h"
#include "io/formats/resident_window.h"
#include "io/formats/text_cursor.h"
#include "io/result_of.h"

namespace folprom::io {
namespace {

/// A block of faces begins at a line.
struct OffFaceBlock {
  FilePosition position;
  uint64_t triangles = 0;
};

uint64_t WordsLeft(TextCursor& cursor) {
  uint64_t words = 0;
  while (!cursor.Word().empty()) ++words;
  return words;
}

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
    std::vector<std::string>& names = index_.notes.ignored_properties;
    if (header_.vertices > 0 && header_.has_normals) names.push_back("normals of vertices");
    if (has_vertex_colours_) names.push_back("colours of vertices");
    if (header_.vertices > 0 && header_.has_texture) {
      names.push_back("texture coordinates of vertices");
    }
    if (has_face_colours_) names.push_back("colours of faces");
  }

  SourceIndex index_;
  std::vector<FilePosition> vertices_;
  std::vector<OffFaceBlock> faces_;

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
    const uint64_t words = WordsLeft(cursor_);
    const uint64_t others = (header_.has_normals ? 3 : 0) + (header_.has_texture ? 2 : 0);
    // Many programs write colours without the C of the keyword.
    const bool has_colour = words == others + 3 || words == others + 4;
    if (!has_colour && (header_.has_colours || words != others)) {
      cursor_.Fail("a vertex has " + std::to_string(3 + words) + " values");
    }
    has_vertex_colours_ |= has_colour;
  }

  void WalkFace(uint64_t face) {
    NextLine("face", face, header_.faces);
    const FilePosition line = cursor_.position();
    const int64_t corners = cursor_.Integer("the number of corners");
    const uint64_t words = WordsLeft(cursor_);
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
    has_face_colours_ |= more > 0;
    const uint64_t triangles = FanTriangles(static_cast<uint64_t>(corners), index_.notes);
    if (triangles == 0) return;
    if (faces_.empty() || faces_.back().triangles + triangles > kBlockTriangles) {
      faces_.push_back({line, 0});
    }
    faces_.back().triangles += triangles;
    index_.triangles += triangles;
  }

  const MappedFile& file_;
  const OffHeader& header_;
  TextCursor cursor_;
  ResidentWindow window_;
  CoordinateCensus census_;
  bool has_vertex_colours_ = false;
  bool has_face_colours_ = false;
};

class TextOffSource final : public IndexedSource {
 public:
  TextOffSource(MappedFile mapped, const OffHeader& header) : IndexedSource(std::move(mapped)) {
    OffIndexer indexer(file(), header);
    indexer.Index();
    index_ = std::move(indexer.index_);
    vertices_ = std::move(indexer.vertices_);
    faces_ = std::move(indexer.faces_);
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

 private:
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
};

}  // namespace

std::unique_ptr<MeshSource> OpenTextOffSource(MappedFile file, const OffHeader& header) {
  return std::make_unique<TextOffSource>(std::move(file), header);
}

}  // namespace folprom::io
