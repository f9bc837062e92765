#include "io/formats/obj_source.h"

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "io/formats/indexed_source.h"
#include "io/formats/obj_blocks.h"
#include "io/formats/polygon_fan.h"
#include "io/formats/text_cursor.h"
#include "io/formats/text_number.h"
#include "io/result_of.h"

namespace folprom::io {
namespace {

/// Steps over lines that are neither vertices nor faces, as the walk did.
class ObjReader {
 public:
  ObjReader(const MappedFile& file, FilePosition position)
      : cursor_(file, position, TextCursor::Lines::kJoined) {}

  TextCursor& cursor() { return cursor_; }

  /// To behind the keyword of the next vertex or face; 'v' or 'f'. The walk saw that there is one.
  char NextCoded() {
    while (cursor_.NextWordLine()) {
      const std::string_view keyword = cursor_.Word();
      if (keyword == "v" || keyword == "f") return keyword[0];
      SkipObjLine(keyword, cursor_);
    }
    cursor_.Fail("the file has changed while it was read");
  }

 private:
  TextCursor cursor_;
};

class ObjSource final : public IndexedSource {
 public:
  explicit ObjSource(MappedFile mapped) : IndexedSource(std::move(mapped)) {
    ObjBlocks blocks = IndexObjBlocks(file());
    index_ = std::move(blocks.index);
    vertices_ = std::move(blocks.vertices);
    faces_ = std::move(blocks.faces);
  }

  Result<void> ReadVertexBlock(size_t block, std::vector<double>* xyz) const override {
    return ResultOf([&] {
      ObjReader reader(file(), vertices_[block]);
      xyz->resize(3 * VerticesIn(block));
      for (size_t i = 0; i < xyz->size(); i += 3) {
        while (reader.NextCoded() != 'v') reader.cursor().SkipLine();
        for (size_t axis = 0; axis < 3; ++axis) {
          (*xyz)[i + axis] = reader.cursor().Coordinate(index_.coordinate_type);
        }
        reader.cursor().SkipLine();
      }
    });
  }

 private:
  Result<void> ReadFaces(size_t block, std::vector<Triangle>* triangles,
                         std::vector<uint8_t>* joins) const override {
    return ResultOf([&] {
      const ObjFaceBlock& where = faces_[block];
      ObjReader reader(file(), where.position);
      triangles->clear();
      triangles->reserve(where.triangles);
      uint64_t vertices_before = where.vertices_before;
      while (triangles->size() < where.triangles) {
        if (reader.NextCoded() == 'v') {
          ++vertices_before;
          reader.cursor().SkipLine();
        } else {
          ReadFace(reader.cursor(), vertices_before, *triangles, joins);
        }
      }
    });
  }

  void ReadFace(TextCursor& cursor, uint64_t vertices_before, std::vector<Triangle>& out,
                std::vector<uint8_t>* joins) const {
    std::array<std::string_view, 3> words;
    for (std::string_view& word : words) {
      word = cursor.Word();
      if (word.empty()) return;  // dropped, as the walk noted
    }
    PolygonFan fan(out, joins);
    for (std::string_view word : words) fan.AddCorner(CornerVertex(cursor, word, vertices_before));
    for (std::string_view word; !(word = cursor.Word()).empty();) {
      fan.AddCorner(CornerVertex(cursor, word, vertices_before));
    }
  }

  /// Of "a", "a/b", "a//c" or "a/b/c"; b and c may be missing behind their stroke.
  uint64_t CornerVertex(const TextCursor& cursor, std::string_view word,
                        uint64_t vertices_before) const {
    size_t begin = word.find('/');
    int64_t index = 0;
    if (!ParseInteger(word.substr(0, begin), &index)) cursor.FailWord(word, "no corner of a face");
    for (int part = 0; begin != std::string_view::npos; ++part) {
      const size_t end = word.find('/', begin + 1);
      const std::string_view other = word.substr(begin + 1, end - begin - 1);
      int64_t ignored = 0;
      if (part == 2 || (!other.empty() && !ParseInteger(other, &ignored))) {
        cursor.FailWord(word, "no corner of a face");
      }
      begin = end;
    }
    // 1 is the first vertex of the file, -1 the last one before the face.
    const uint64_t vertex = index < 0 ? vertices_before + static_cast<uint64_t>(index)
                                      : static_cast<uint64_t>(index) - 1;
    if (vertex >= (index < 0 ? vertices_before : index_.vertices)) {
      ThrowNoVertex(cursor, index, vertices_before);
    }
    return vertex;
  }

  [[noreturn]] void ThrowNoVertex(const TextCursor& cursor, int64_t index,
                                  uint64_t vertices_before) const {
    const std::string name = "the vertex index " + std::to_string(index);
    if (index == 0) cursor.Fail(name + " is no vertex: the first is 1");
    if (index > 0) {
      cursor.Fail(name + " is beyond the " + std::to_string(index_.vertices) +
                  " vertices of the file");
    }
    cursor.Fail(name + " goes back beyond the " + std::to_string(vertices_before) +
                " vertices before the face");
  }

  std::vector<FilePosition> vertices_;
  std::vector<ObjFaceBlock> faces_;
};

}  // namespace

std::unique_ptr<MeshSource> OpenObjSource(MappedFile file) {
  return std::make_unique<ObjSource>(std::move(file));
}

}  // namespace folprom::io
