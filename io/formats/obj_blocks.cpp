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
  explicit ObjIndexer(const MappedFile& file)
      : cursor_(file, {0, 1}, TextCursor::Lines::kJoined), window_(file) {}

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
    NoteWhatIsNotCoded();
    return std::move(blocks_);
  }

 private:
  void WalkVertex(FilePosition line) {
    if (blocks_.index.vertices++ % kBlockVertices == 0) blocks_.vertices.push_back(line);
    census_.AddPosition(cursor_);
    uint64_t more = 0;
    for (std::string_view word; !(word = cursor_.Word()).empty(); ++more) {
      double value = 0;
      if (!ParseReal(word, &value)) cursor_.FailWord(word, "not a number");
    }
    // x y z [w] [r g b [a]]
    if (more == 2 || more > 5) {
      cursor_.Fail("a vertex has " + std::to_string(3 + more) + " values");
    }
    has_weights_ |= more == 1;
    has_colours_ |= more >= 3;
  }

  void WalkFace(FilePosition line) {
    uint64_t corners = 0;
    while (!cursor_.Word().empty()) ++corners;
    const uint64_t triangles = FanTriangles(corners, blocks_.index.notes);
    if (triangles == 0) return;
    if (blocks_.faces.empty() || blocks_.faces.back().triangles + triangles > kBlockTriangles) {
      blocks_.faces.push_back({line, blocks_.index.vertices, 0});
    }
    blocks_.faces.back().triangles += triangles;
    blocks_.index.triangles += triangles;
  }

  void WalkUncoded(std::string_view keyword) {
    const Uncoded* uncoded = FindUncoded(keyword);
    if (uncoded == nullptr) cursor_.FailWord(keyword, "no keyword of an OBJ file");
    seen_.set(static_cast<size_t>(uncoded - kUncoded));
    if (keyword == "vn" || keyword == "vt") {
      WalkAttribute(keyword);
    } else {
      SkipObjLine(keyword, cursor_);
    }
  }

  // Values that are skipped are not parsed; their number tells two lines that became one.
  void WalkAttribute(std::string_view keyword) {
    uint64_t values = 0;
    while (!cursor_.Word().empty()) ++values;
    if (values < (keyword == "vn" ? 3 : 1) || values > 3) {
      cursor_.Fail(std::string(keyword) + " has " + std::to_string(values) + " values");
    }
  }

  void NoteWhatIsNotCoded() {
    std::vector<std::string>& names = blocks_.index.notes.ignored_properties;
    if (has_weights_) names.push_back("weights of vertices (v)");
    if (has_colours_) names.push_back("colours of vertices (v)");
    for (size_t i = 0; i < std::size(kUncoded); ++i) {
      if (seen_[i]) names.push_back(kUncoded[i].meaning);
    }
  }

  TextCursor cursor_;
  ResidentWindow window_;
  CoordinateCensus census_;
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

ObjBlocks IndexObjBlocks(const MappedFile& file) { return ObjIndexer(file).Index(); }

}  // namespace folprom::io
