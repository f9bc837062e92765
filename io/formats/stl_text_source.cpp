#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/formats/file_position.h"
#include "io/formats/resident_window.h"
#include "io/formats/soup_source.h"
#include "io/formats/stl_source.h"
#include "io/formats/text_cursor.h"
#include "io/result_of.h"

namespace folprom::io {
namespace {

/// Steps through "solid ... facet ... endfacet ... endsolid", line breaks being blanks.
class StlTextParser {
 public:
  StlTextParser(const MappedFile& file, FilePosition position) : cursor_(file, position) {}

  TextCursor& cursor() { return cursor_; }

  /// To the next facet; false at the end of the file, which must be outside of a solid.
  bool NextFacet(bool inside) {
    while (cursor_.NextWordLine()) {
      const FilePosition begin = cursor_.position();
      const std::string_view word = cursor_.Word();
      if (inside && EqualsIgnoringCase(word, "facet")) {
        facet_ = begin;
        return true;
      }
      if (!EqualsIgnoringCase(word, inside ? "endsolid" : "solid")) {
        cursor_.FailWord(word, inside ? "neither facet nor endsolid" : "not solid");
      }
      inside = !inside;
      if (inside) ++solids_;
      cursor_.SkipSingleLine();  // its name
    }
    if (inside) cursor_.Fail("the file ends before endsolid");
    return false;
  }

  /// From behind the keyword "facet" to behind "endfacet"; calls use() before each coordinate.
  template <class UsePosition>
  void Facet(UsePosition use_position) {
    Expect("normal");
    for (int i = 0; i < 3; ++i) Word();
    Expect("outer");
    Expect("loop");
    for (int corner = 0; corner < 3; ++corner) {
      Expect("vertex");
      use_position(cursor_);
    }
    Expect("endloop");
    Expect("endfacet");
  }

  FilePosition facet() const { return facet_; }
  uint64_t solids() const { return solids_; }

 private:
  std::string_view Word() {
    if (!cursor_.NextWordLine()) cursor_.Fail("the file ends in a facet");
    return cursor_.Word();
  }
  void Expect(const char* keyword) {
    const std::string_view word = Word();
    if (!EqualsIgnoringCase(word, keyword)) {
      cursor_.FailWord(word, (std::string("in the place of ") + keyword).c_str());
    }
  }

  TextCursor cursor_;
  FilePosition facet_;
  uint64_t solids_ = 0;
};

class TextStlSource final : public SoupSource {
 public:
  explicit TextStlSource(MappedFile mapped) : SoupSource(std::move(mapped)) {
    StlTextParser parser(file(), {0, 1});
    ResidentWindow window(file());
    CoordinateCensus census;
    uint64_t facets = 0;
    for (bool inside = false; parser.NextFacet(inside); inside = true, ++facets) {
      if (facets % kBlockFacets == 0) {
        blocks_.push_back(parser.facet());
        window.Advance(parser.facet().offset);
      }
      parser.Facet([&](TextCursor& cursor) { census.AddPosition(cursor); });
    }
    SetFacets(facets);
    index_.coordinate_type = census.type();
    std::vector<std::string>& names = index_.notes.ignored_properties;
    if (facets > 0) names.push_back("facet normals");
    if (parser.solids() > 1) {
      names.push_back("the parting into " + std::to_string(parser.solids()) + " solids");
    }
  }

  Result<void> ReadVertexBlock(size_t block, std::vector<double>* xyz) const override {
    return ResultOf([&] {
      StlTextParser parser(file(), blocks_[block]);
      xyz->resize(3 * VerticesIn(block));
      double* to = xyz->data();
      for (uint64_t i = 0; i < VerticesIn(block) / 3; ++i) {
        if (!parser.NextFacet(true)) parser.cursor().Fail("the file has changed while it was read");
        parser.Facet([&](TextCursor& cursor) {
          for (int axis = 0; axis < 3; ++axis) *to++ = cursor.Coordinate(index_.coordinate_type);
        });
      }
    });
  }

 private:
  std::vector<FilePosition> blocks_;
};

}  // namespace

std::unique_ptr<MeshSource> OpenTextStlSource(MappedFile file) {
  return std::make_unique<TextStlSource>(std::move(file));
}

}  // namespace folprom::io
