#include "io/formats/obj_blocks.h"

#include <algorithm>
#include <bitset>
#include <iterator>
#include <string>
#include <utility>

#include "io/formats/polygon_fan.h"
#include "io/formats/resident_window.h"
#include "io/formats/text_cursor.h"
#include "io/formats/text_number.h"

namespace folprom::io {
namespace {

/// A line that is not coded, in the words of the warning.
struct Uncoded {
  std::string_view keyword;
  const char* meaning;
  bool is_name = false;  // the rest of the line is a name
};

constexpr Uncoded kUncoded[] = {
    {"vn", "normals (vn)"},
    {"vt", "texture coordinates (vt)"},
    {"vp", "points of parameter space (vp)"},
    {"g", "groups (g)", true},
    {"o", "object names (o)", true},
    {"s", "smoothing groups (s)"},
    {"mg", "merging groups (mg)"},
    {"usemtl", "materials (usemtl)", true},
    {"mtllib", "material files (mtllib)", true},
    {"usemap", "texture maps (usemap)", true},
    {"maplib", "texture map files (maplib)", true},
    {"shadow_obj", "shadow objects (shadow_obj)", true},
    {"trace_obj", "tracing objects (trace_obj)", true},
    {"p", "point elements (p)"},
    {"l", "line elements (l)"},
    {"curv", "curves (curv)"},
    {"curv2", "curves (curv2)"},
    {"surf", "surfaces (surf)"},
    {"cstype", "free-form types (cstype)"},
    {"deg", "free-form degrees (deg)"},
    {"bmat", "free-form bases (bmat)"},
    {"step", "free-form steps (step)"},
    {"parm", "free-form parameters (parm)"},
    {"trim", "trimming curves (trim)"},
    {"hole", "holes (hole)"},
    {"scrv", "special curves (scrv)"},
    {"sp", "special points (sp)"},
    {"end", "ends of free-form elements (end)"},
    {"con", "connections of surfaces (con)"},
    {"bevel", "display attributes (bevel)"},
    {"c_interp", "display attributes (c_interp)"},
    {"d_interp", "display attributes (d_interp)"},
    {"lod", "display attributes (lod)"},
    {"ctech", "display attributes (ctech)"},
    {"stech", "display attributes (stech)"},
    {"call", "other files (call)", true},
    {"csh", "shell commands (csh)", true},
};

const Uncoded* FindUncoded(std::string_view keyword) {
  const Uncoded* found = std::ranges::find(kUncoded, keyword, &Uncoded::keyword);
  return found == std::end(kUncoded) ? nullptr : found;
}

class ObjIndexer {
 public:
  ObjIndexer(const MappedFile& file, const Limits& limits)
      : file_(file),
        cursor_(file, {0, 1}, TextCursor::Lines::kJoined),
        window_(file),
        names_(std::min<uint64_t>(limits.comment_bytes, kMostRemarkBytes)) {}

  ObjBlocks Index() {
    while (cursor_.NextWordLine()) {
      const FilePosition line = cursor_.position();
      window_.Advance(line.offset);
      const std::string_view keyword = cursor_.Word();
      if (keyword == "v") {
        WalkVertex(line);
      } else if (keyword == "f") {
        WalkFace(line);
      } else {
        WalkUncoded(keyword);
      }
    }
    blocks_.index.triangle_blocks = blocks_.faces.size();
    blocks_.index.coordinate_type = census_.type();
    NameVertexAttributes();
    NameFaceAttributes();
    NoteWhatIsNotCoded();
    blocks_.names = std::move(names_);
    return std::move(blocks_);
  }

 private:
  void WalkVertex(FilePosition line) {
    if (blocks_.index.vertices++ % kBlockVertices == 0) blocks_.vertices.push_back(line);
    census_.AddPosition(cursor_);
    uint64_t more = 0;
    for (std::string_view word; !(word = cursor_.Word()).empty(); ++more)
      others_.Add(word, cursor_);
    // x y z [w] [r g b [a]]
    if (more == 2 || more > 5) {
      cursor_.Fail("a vertex has " + std::to_string(3 + more) + " values");
    }
    has_weights_ |= more == 1 || more == 5;
    has_colours_ |= more >= 3;
    if (blocks_.index.vertices == 1) more_ = more;
    is_even_ &= more == more_;
  }

  void WalkFace(FilePosition line) {
    uint64_t corners = 0;
    std::array<uint64_t, kObjLists> named{};
    for (std::string_view word; !(word = cursor_.Word()).empty(); ++corners) {
      const size_t stroke = word.find('/');
      if (stroke == std::string_view::npos) continue;
      const size_t second = std::min(word.find('/', stroke + 1), word.size());
      named[kTextures] += second > stroke + 1;
      named[kNormals] += second + 1 < word.size();
    }
    const uint64_t triangles = FanTriangles(corners, blocks_.index.notes);
    if (triangles == 0) return;
    if (blocks_.faces.empty() || blocks_.faces.back().triangles + triangles > kBlockTriangles) {
      blocks_.faces.push_back({line,
                               blocks_.index.vertices,
                               {lists_[kTextures].count(), lists_[kNormals].count()},
                               state_,
                               0});
    }
    // Blocks of faces are not cut inside of one, but a row of a huge one has too much of it.
    has_huge_faces_ |= triangles > kBlockTriangles;
    for (size_t i = 0; i < kObjLists; ++i) named_[i] |= named[i] > 0;
    blocks_.faces.back().triangles += triangles;
    blocks_.index.triangles += triangles;
  }

  void WalkUncoded(std::string_view keyword) {
    const Uncoded* uncoded = FindUncoded(keyword);
    if (uncoded == nullptr) cursor_.FailWord(keyword, "no keyword of an OBJ file");
    seen_.set(static_cast<size_t>(uncoded - kUncoded));
    const size_t statement = ObjNames::StatementOf(keyword);
    if (keyword == "vn" || keyword == "vt") {
      WalkAttribute(keyword);
    } else if (statement < kObjStatements.size()) {
      state_[statement] = names_.Add(statement, TakeObjName(keyword, cursor_));
    } else if (keyword == kMaterialFiles) {
      names_.AddMaterialFile(cursor_.RestOfLine());
    } else {
      SkipObjLine(keyword, cursor_);
    }
  }

  // The number of values tells two lines that became one.
  void WalkAttribute(std::string_view keyword) {
    const size_t list = keyword == "vn" ? kNormals : kTextures;
    std::array<std::string_view, 3> words;
    size_t count = 0;
    for (std::string_view word; !(word = cursor_.Word()).empty(); ++count) {
      if (count < words.size()) words[count] = word;
    }
    if (count < (keyword == "vn" ? 3 : 1) || count > words.size()) {
      cursor_.Fail(std::string(keyword) + " has " + std::to_string(count) + " values");
    }
    std::array<double, 3> values{};
    for (size_t i = 0; i < count; ++i) values[i] = list_numbers_[list].Add(words[i], cursor_);
    lists_[list].Add(values, count, file_);
  }

  void NameVertexAttributes() {
    if (!is_even_ || more_ == 0) return;
    const ScalarType type = others_.type();
    std::vector<VertexAttribute>& attributes = blocks_.index.schema.attributes;
    if (has_weights_) attributes.push_back({"w", type});
    if (has_colours_) {
      for (const char* name : {"red", "green", "blue"}) attributes.push_back({name, type});
    }
    if (more_ >= 4) attributes.push_back({"alpha", type});
  }

  void NameFaceAttributes() {
    if (has_huge_faces_ || blocks_.index.triangles == 0) return;
    FaceSchema& schema = blocks_.index.face_schema;
    for (size_t s = 0; s < kObjStatements.size() && names_.is_whole(); ++s) {
      if (!names_.Has(s)) continue;
      schema.attributes.push_back({std::string(kObjStatements[s].attribute), ScalarType::kUint32});
    }
    if (names_.is_whole()) blocks_.index.remarks = names_.remarks();
    for (size_t i = 0; i < kObjLists; ++i) {
      if (!named_[i] || lists_[i].count() == 0) continue;
      blocks_.values[i] = lists_[i].Take();
      blocks_.values[i].type = list_numbers_[i].type();
      schema.attributes.push_back({std::string(kObjListNames[i]), blocks_.values[i].type,
                                   static_cast<uint32_t>(blocks_.values[i].columns)});
    }
  }

  /// Is what this statement says an attribute, or a remark.
  bool IsKept(std::string_view keyword) const {
    const FaceSchema& schema = blocks_.index.face_schema;
    const auto has = [&](std::string_view name) {
      return std::ranges::find(schema.attributes, name, &FaceAttribute::name) !=
             schema.attributes.end();
    };
    const size_t statement = ObjNames::StatementOf(keyword);
    if (statement < kObjStatements.size()) return has(kObjStatements[statement].attribute);
    for (size_t i = 0; i < kObjLists; ++i) {
      if (keyword == kObjListKeywords[i]) return has(kObjListNames[i]);
    }
    return keyword == kMaterialFiles && !blocks_.index.remarks.empty();
  }

  void NoteWhatIsNotCoded() {
    std::vector<std::string>& names = blocks_.index.notes.ignored_properties;
    const bool keeps_more = !blocks_.index.schema.attributes.empty();
    if (has_weights_ && !keeps_more) names.push_back("weights of vertices (v)");
    if (has_colours_ && !keeps_more) names.push_back("colours of vertices (v)");
    for (size_t i = 0; i < std::size(kUncoded); ++i) {
      if (seen_[i] && !IsKept(kUncoded[i].keyword)) names.push_back(kUncoded[i].meaning);
    }
  }

  const MappedFile& file_;
  TextCursor cursor_;
  ResidentWindow window_;
  CoordinateCensus census_;
  CoordinateCensus others_;  ///< of what vertices have beside positions
  uint64_t more_ = 0;        ///< numbers of that
  bool is_even_ = true;      ///< each vertex has as many
  ObjNames names_;
  ObjState state_{};
  std::array<ObjValueWriter, kObjLists> lists_;
  std::array<CoordinateCensus, kObjLists> list_numbers_;
  std::array<bool, kObjLists> named_{};  ///< by a corner of a face
  bool has_huge_faces_ = false;
  std::bitset<std::size(kUncoded)> seen_;
  bool has_weights_ = false;
  bool has_colours_ = false;
  ObjBlocks blocks_;
};

}  // namespace

bool IsObjKeyword(std::string_view word) {
  return word == "v" || word == "f" || FindUncoded(word) != nullptr;
}

void SkipObjLine(std::string_view keyword, TextCursor& cursor) {
  const Uncoded* uncoded = FindUncoded(keyword);
  if (uncoded != nullptr && uncoded->is_name) {
    cursor.SkipSingleLine();
  } else {
    cursor.SkipLine();
  }
}

std::string_view TakeObjName(std::string_view keyword, TextCursor& cursor) {
  const Uncoded* uncoded = FindUncoded(keyword);
  if (uncoded != nullptr && uncoded->is_name) return cursor.RestOfLine();
  const std::string_view name = cursor.Word();
  cursor.SkipLine();
  return name;
}

ObjBlocks IndexObjBlocks(const MappedFile& file, const Limits& limits) {
  return ObjIndexer(file, limits).Index();
}

}  // namespace folprom::io
