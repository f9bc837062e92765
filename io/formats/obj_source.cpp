#include "io/formats/obj_source.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "io/formats/indexed_source.h"
#include "io/formats/obj_blocks.h"
#include "io/formats/polygon_fan.h"
#include "io/formats/store_bytes.h"
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

  /// To behind the keyword of the next line. The walk saw that there is one.
  std::string_view NextKeyword() {
    if (!cursor_.NextWordLine()) cursor_.Fail("the file has changed while it was read");
    return cursor_.Word();
  }

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

/// What a corner of a face names, by 0 .. counts; kNone where it names nothing.
struct ObjCorner {
  static constexpr uint64_t kNone = ~uint64_t{0};
  uint64_t vertex = 0;
  std::array<uint64_t, kObjLists> lists{kNone, kNone};
};

class ObjSource final : public IndexedSource {
 public:
  ObjSource(MappedFile mapped, const Limits& limits) : IndexedSource(std::move(mapped)) {
    blocks_ = IndexObjBlocks(file(), limits);
    index_ = std::move(blocks_.index);
    for (size_t i = 0; i < kObjLists; ++i) {
      if (blocks_.values[i].file != nullptr) values_[i] = blocks_.values[i].file->Map();
    }
    for (size_t s = 0; s < kObjStatements.size(); ++s) keeps_[s] = HasAttribute(s);
    row_bytes_ = index_.face_schema.RowBytes();
  }

  Result<void> ReadVertexBlock(size_t block, std::vector<double>* xyz) const override {
    return ResultOf([&] {
      ObjReader reader(file(), blocks_.vertices[block]);
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

  Result<void> ReadVertexAttributes(size_t block, std::vector<uint8_t>* values) const override {
    values->clear();
    if (index_.schema.attributes.empty()) return {};
    return ResultOf([&] {
      ObjReader reader(file(), blocks_.vertices[block]);
      values->resize(VerticesIn(block) * index_.schema.Stride());
      uint8_t* to = values->data();
      for (uint64_t i = VerticesIn(block); i > 0; --i) {
        while (reader.NextCoded() != 'v') reader.cursor().SkipLine();
        for (size_t axis = 0; axis < 3; ++axis) reader.cursor().Word();
        for (const VertexAttribute& attribute : index_.schema.attributes) {
          to = StoreReal(attribute.type, reader.cursor().Coordinate(attribute.type), to);
        }
        reader.cursor().SkipLine();
      }
    });
  }

  Result<void> ReadFaceAttributes(size_t block, std::vector<uint8_t>* rows) const override {
    rows->clear();
    if (index_.face_schema.empty()) return {};
    return ResultOf([&] {
      const size_t bytes = faces_of(block).triangles * row_bytes_;
      rows->reserve(bytes);
      ObjPlace place{faces_of(block).vertices_before, faces_of(block).lists_before,
                     faces_of(block).state};
      ObjReader reader(file(), faces_of(block).position);
      std::vector<ObjCorner> corners;
      while (rows->size() < bytes) {
        if (!ReadStatement(reader, &place)) continue;
        corners.clear();
        for (std::string_view word; !(word = reader.cursor().Word()).empty();) {
          corners.push_back(CornerOf(reader.cursor(), word, place));
        }
        AddRows(corners, place.state, rows);
      }
    });
  }

 private:
  /// What stands before a face.
  struct ObjPlace {
    uint64_t vertices = 0;
    std::array<uint64_t, kObjLists> lists{};
    ObjState state{};
  };

  const ObjFaceBlock& faces_of(size_t block) const { return blocks_.faces[block]; }

  bool HasAttribute(size_t statement) const {
    return std::ranges::find(index_.face_schema.attributes, kObjStatements[statement].attribute,
                             &FaceAttribute::name) != index_.face_schema.attributes.end();
  }

  /// Takes the next line; true, behind its keyword, where it is a face.
  bool ReadStatement(ObjReader& reader, ObjPlace* place) const {
    const std::string_view keyword = reader.NextKeyword();
    if (keyword == "f") return true;
    const size_t statement = ObjNames::StatementOf(keyword);
    if (statement < kObjStatements.size()) {
      place->state[statement] =
          blocks_.names.NumberOf(statement, TakeObjName(keyword, reader.cursor()));
      return false;
    }
    if (keyword == "v") ++place->vertices;
    for (size_t i = 0; i < kObjLists; ++i) place->lists[i] += keyword == kObjListKeywords[i];
    SkipObjLine(keyword, reader.cursor());
    return false;
  }

  /// In the order of the schema: statements, then lists.
  void AddRows(const std::vector<ObjCorner>& corners, const ObjState& state,
               std::vector<uint8_t>* rows) const {
    for (size_t corner = 2; corner < corners.size(); ++corner) {
      const size_t begin = rows->size();
      rows->resize(begin + row_bytes_);
      uint8_t* to = rows->data() + begin;
      for (size_t s = 0; s < state.size(); ++s) {
        if (keeps_[s]) to = StoreLittleEndian(state[s], to);
      }
      for (const size_t c : {size_t{0}, corner - 1, corner}) to = AddCorner(corners[c], to);
    }
  }

  /// Not a number stands for what a corner does not name.
  uint8_t* AddCorner(const ObjCorner& corner, uint8_t* to) const {
    for (size_t list = 0; list < kObjLists; ++list) {
      for (size_t i = 0; i < blocks_.values[list].columns; ++i) {
        double value = std::numeric_limits<double>::quiet_NaN();
        if (corner.lists[list] != ObjCorner::kNone) {
          std::memcpy(&value,
                      values_[list].bytes().data() + (3 * corner.lists[list] + i) * sizeof value,
                      sizeof value);
        }
        to = StoreReal(blocks_.values[list].type, value, to);
      }
    }
    return to;
  }

  Result<void> ReadFaces(size_t block, std::vector<Triangle>* triangles,
                         std::vector<uint8_t>* joins) const override {
    return ResultOf([&] {
      const ObjFaceBlock& where = faces_of(block);
      ObjReader reader(file(), where.position);
      triangles->clear();
      triangles->reserve(where.triangles);
      ObjPlace place;
      place.vertices = where.vertices_before;
      while (triangles->size() < where.triangles) {
        if (reader.NextCoded() == 'v') {
          ++place.vertices;
          reader.cursor().SkipLine();
        } else {
          ReadFace(reader.cursor(), place, *triangles, joins);
        }
      }
    });
  }

  void ReadFace(TextCursor& cursor, const ObjPlace& place, std::vector<Triangle>& out,
                std::vector<uint8_t>* joins) const {
    std::array<std::string_view, 3> words;
    for (std::string_view& word : words) {
      word = cursor.Word();
      if (word.empty()) return;  // dropped, as the walk noted
    }
    PolygonFan fan(out, joins);
    for (std::string_view word : words) fan.AddCorner(VertexOf(cursor, word, place));
    for (std::string_view word; !(word = cursor.Word()).empty();) {
      fan.AddCorner(VertexOf(cursor, word, place));
    }
  }

  /// The numbers of "a", "a/b", "a//c" or "a/b/c"; b and c may be missing behind their stroke.
  static std::array<std::optional<int64_t>, 1 + kObjLists> NumbersOf(const TextCursor& cursor,
                                                                     std::string_view word) {
    std::array<std::optional<int64_t>, 1 + kObjLists> numbers;
    std::string_view left = word;
    for (size_t part = 0;; ++part) {
      const size_t end = std::min(left.find('/'), left.size());
      int64_t number = 0;
      const bool is_number = ParseInteger(left.substr(0, end), &number);
      if (part == numbers.size() || (!is_number && (end > 0 || part == 0))) {
        cursor.FailWord(word, "no corner of a face");
      }
      if (is_number) numbers[part] = number;
      if (end == left.size()) return numbers;
      left.remove_prefix(end + 1);
    }
  }

  /// 1 is the first of the file, -1 the last one before the face.
  static uint64_t IndexOf(int64_t number, uint64_t before) {
    return number < 0 ? before + static_cast<uint64_t>(number) : static_cast<uint64_t>(number) - 1;
  }

  uint64_t VertexOf(const TextCursor& cursor, std::string_view word, const ObjPlace& place) const {
    return CheckedVertex(cursor, *NumbersOf(cursor, word)[0], place.vertices);
  }

  uint64_t CheckedVertex(const TextCursor& cursor, int64_t number, uint64_t before) const {
    const uint64_t vertex = IndexOf(number, before);
    if (vertex >= (number < 0 ? before : index_.vertices)) ThrowNoVertex(cursor, number, before);
    return vertex;
  }

  ObjCorner CornerOf(const TextCursor& cursor, std::string_view word, const ObjPlace& place) const {
    const auto numbers = NumbersOf(cursor, word);
    ObjCorner corner;
    corner.vertex = CheckedVertex(cursor, *numbers[0], place.vertices);
    for (size_t i = 0; i < kObjLists; ++i) {
      if (!numbers[1 + i] || values_[i].bytes().empty()) continue;
      const int64_t number = *numbers[1 + i];
      corner.lists[i] = IndexOf(number, place.lists[i]);
      const uint64_t count = number < 0 ? place.lists[i] : blocks_.values[i].count;
      if (corner.lists[i] >= count) {
        cursor.Fail("the index " + std::to_string(number) + " is none of the " +
                    std::to_string(count) + " " + std::string(kObjListKeywords[i]));
      }
    }
    return corner;
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

  ObjBlocks blocks_;  // without the index
  std::array<MappedFile, kObjLists> values_;
  std::array<bool, kObjStatements.size()> keeps_{};  ///< is the statement an attribute
  size_t row_bytes_ = 0;
};

}  // namespace

std::unique_ptr<MeshSource> OpenObjSource(MappedFile file, const Limits& limits) {
  return std::make_unique<ObjSource>(std::move(file), limits);
}

}  // namespace folprom::io
