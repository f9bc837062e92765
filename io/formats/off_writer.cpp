// OFF: normals, colours and texture coordinates of vertices behind their coordinates, by the
// letters before the keyword; colours of faces behind their corners.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "io/formats/off_header.h"
#include "io/formats/text_writer.h"

namespace folprom::io {
namespace {

bool IsIn(std::string_view name, std::span<const std::string_view> names) {
  return std::ranges::find(names, name) != names.end();
}

class OffWriter final : public TextWriter {
 public:
  OffWriter(const std::string& path, const MeshShape& shape, bool force)
      : TextWriter(path, shape, force, "OFF"),
        normals_(ColumnsNamed(shape.schema, kOffNormals)),
        colours_(ColourColumns(shape.schema)),
        texture_(ColumnsNamed(shape.schema, kOffTexture)),
        face_colours_(ColourColumns(shape.face_schema)),
        face_index_(ColumnsNamed(shape.face_schema, {&kOffColourIndex, 1})),
        face_count_(ColumnsNamed(shape.face_schema, {&kOffColourCount, 1})) {
    if (!face_colours_.empty()) face_index_.clear();
    const bool counts = !face_count_.empty() && face_count_[0].type() == ScalarType::kUint8;
    if (face_colours_.empty() || !counts) face_count_.clear();
    std::string header;
    if (!texture_.empty()) header += "ST";
    if (!colours_.empty()) header += "C";
    if (!normals_.empty()) header += "N";
    vertices().Add(header + "OFF\n" + std::to_string(shape.vertices) + " " +
                   std::to_string(shape.faces) + " 0\n");
  }

 private:
  bool Holds(const VertexAttribute& attribute) const override {
    if (IsIn(attribute.name, kOffNormals)) return !normals_.empty();
    if (attribute.name == "alpha") return colours_.size() == 4;
    if (IsIn(attribute.name, kOffColours)) return !colours_.empty();
    return IsIn(attribute.name, kOffTexture) && !texture_.empty();
  }
  bool Holds(const FaceAttribute& attribute) const override {
    if (attribute.per_corner > 0) return false;
    if (attribute.name == "alpha") return face_colours_.size() == 4;
    if (IsIn(attribute.name, kOffColours)) return !face_colours_.empty();
    if (attribute.name == kOffColourIndex) return !face_index_.empty();
    return attribute.name == kOffColourCount && !face_count_.empty();
  }
  uint64_t PayloadsLost() const override {
    uint64_t lost = 0;
    for (const auto* columns : {&normals_, &colours_, &texture_, &face_colours_}) {
      for (const TextColumn& column : *columns) lost += column.payloads_lost();
    }
    return lost;
  }

  static void Add(OutputBuffer& out, std::string_view text) {
    out.Add(" ");
    out.Add(text);
  }

  /// Whole numbers are of 0 .. 255, so a part of 1 must not look like one.
  static void AddColour(OutputBuffer& out, TextColumn& column, std::span<const uint8_t> values) {
    const std::string_view text = column.Text(values);
    Add(out, text);
    if (IsFloat(column.type()) && text.find_first_not_of("-0123456789") == std::string_view::npos) {
      out.Add(".0");
    }
  }

  void WriteVertices(std::span<const double> xyz, std::span<const uint8_t> attributes) override {
    const size_t stride = shape().schema.Stride();
    for (size_t i = 0; i < xyz.size(); i += 3, attributes = attributes.subspan(stride)) {
      AddPosition(xyz.subspan(i, 3));
      for (TextColumn& column : normals_) Add(vertices(), column.Text(attributes));
      for (TextColumn& column : colours_) AddColour(vertices(), column, attributes);
      for (TextColumn& column : texture_) Add(vertices(), column.Text(attributes));
      vertices().Add("\n");
    }
  }

  void WritePolygon(std::span<const uint64_t> corners, const FaceValues& values) override {
    AddNumber("", corners.size());
    for (const uint64_t index : corners) AddNumber(" ", index);
    size_t colours = face_colours_.size();
    if (!face_count_.empty()) {
      colours = std::min(colours, static_cast<size_t>(face_count_[0].Real(values.face)));
    }
    for (size_t i = 0; i < colours; ++i) AddColour(faces(), face_colours_[i], values.face);
    for (TextColumn& column : face_index_) Add(faces(), column.Text(values.face));
    faces().Add("\n");
  }

  std::vector<TextColumn> normals_, colours_, texture_;  ///< of vertices
  std::vector<TextColumn> face_colours_, face_index_, face_count_;
};

}  // namespace

std::unique_ptr<MeshWriter> MakeOffWriter(const std::string& path, const MeshShape& shape,
                                          bool force) {
  return std::make_unique<OffWriter>(path, shape, force);
}

}  // namespace folprom::io
