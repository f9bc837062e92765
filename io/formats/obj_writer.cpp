// OBJ: colours of vertices behind their coordinates, texture coordinates and normals as "vt" and
// "vn", named statements before the faces that they hold for.
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "io/formats/obj_statements.h"
#include "io/formats/text_writer.h"

namespace folprom::io {
namespace {

/// "vt" or "vn" of corners: which line says the same already.
class CornerLines {
 public:
  /// None where corners have no such list of at most `most` numbers.
  CornerLines(const char* keyword, const FaceSchema& schema, std::string_view name, size_t most)
      : keyword_(keyword) {
    size_t offset = 0;
    for (const FaceAttribute& attribute : schema.attributes) {
      if (attribute.per_corner == 0) continue;
      if (attribute.name == name && attribute.per_corner <= most && IsFloat(attribute.type)) {
        columns_.clear();
        for (size_t i = 0; i < attribute.per_corner; ++i) {
          columns_.emplace_back(attribute.type, i * ScalarSize(attribute.type));
        }
        offset_ = offset;
        bytes_ = attribute.bytes();
        decimals_ = DecimalWriter(attribute.type);
      }
      offset += attribute.bytes();
    }
    known_.resize(kKnown * bytes_);
  }

  bool any() const { return !columns_.empty(); }
  uint64_t payloads_lost() const { return decimals_.payloads_lost(); }

  /// Its number; 0 where the corner has none. Writes the line where it is not known.
  uint64_t NumberOf(std::span<const uint8_t> corner, OutputBuffer& out) {
    const auto values = corner.subspan(offset_, bytes_);
    if (std::ranges::all_of(
            columns_, [&](const TextColumn& column) { return std::isnan(column.Real(values)); })) {
      return 0;
    }
    const auto found = numbers_.find(ViewOf(values));
    if (found != numbers_.end()) return found->second;
    const std::span<uint8_t> kept = std::span(known_).subspan(lines_ % kKnown * bytes_, bytes_);
    if (lines_ >= kKnown) numbers_.erase(ViewOf(kept));
    std::ranges::copy(values, kept.begin());
    numbers_.emplace(ViewOf(kept), ++lines_);
    out.Add(keyword_);
    for (const TextColumn& column : columns_) {
      out.Add(" ");
      out.Add(decimals_.Text(column.Real(values)));
    }
    out.Add("\n");
    return lines_;
  }

 private:
  /// Neighbours in the file say the same; what is forgotten is written again.
  static constexpr size_t kKnown = 1 << 16;

  static std::string_view ViewOf(std::span<const uint8_t> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }

  const char* keyword_;
  std::vector<TextColumn> columns_;
  size_t offset_ = 0, bytes_ = 0;  ///< of them, among the values of a corner
  DecimalWriter decimals_{ScalarType::kFloat32};
  uint64_t lines_ = 0;
  std::vector<uint8_t> known_;                              ///< values of the last kKnown lines
  std::unordered_map<std::string_view, uint64_t> numbers_;  ///< of these lines
};

template <class Attribute>
bool IsOneOf(const Attribute& attribute, std::initializer_list<std::string_view> names) {
  return std::ranges::find(names, attribute.name) != names.end();
}

class ObjWriter final : public TextWriter {
 public:
  ObjWriter(const std::string& path, const MeshShape& shape, bool force)
      : TextWriter(path, shape, force, "OBJ"),
        remarks_(shape.remarks),
        colours_(ColourColumns(shape.schema)),
        texture_(TextureColumns(shape.schema)),
        corner_texture_("vt", shape.face_schema, "texcoord", 3),
        corner_normals_("vn", shape.face_schema, "normal", 3) {
    constexpr std::string_view kNormal[] = {"nx", "ny", "nz"};
    normals_ = ColumnsNamed(shape.schema, kNormal);
    if (!normals_.empty() && !IsFloat(normals_[0].type())) normals_.clear();
    if (corner_texture_.any()) texture_.clear();
    if (corner_normals_.any()) normals_.clear();
    for (const ObjStatement& statement : kObjStatements) {
      statements_.push_back(ColumnsNamed(shape.face_schema, {&statement.attribute, 1}));
      if (!statements_.back().empty() && IsFloat(statements_.back()[0].type())) {
        statements_.back().clear();
      }
    }
    // A file of no byte at all would be taken for a fault.
    vertices().Add("# " + std::to_string(shape.vertices) + " vertices, " +
                   std::to_string(shape.faces) + " faces\n");
    for (const std::string& name : remarks_.material_files()) {
      vertices().Add("mtllib " + name + "\n");
    }
  }

 private:
  static std::vector<TextColumn> TextureColumns(const VertexSchema& schema) {
    constexpr std::string_view kNames[][2] = {{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}};
    for (const auto& names : kNames) {
      std::vector<TextColumn> columns = ColumnsNamed(schema, names);
      if (!columns.empty() && IsFloat(columns[0].type())) return columns;
    }
    return {};
  }

  bool Holds(const VertexAttribute& attribute) const override {
    if (IsOneOf(attribute, {"red", "green", "blue"})) return !colours_.empty();
    if (attribute.name == "alpha") return colours_.size() == 4;
    if (IsOneOf(attribute, {"nx", "ny", "nz"})) return !normals_.empty();
    return IsOneOf(attribute, {"s", "t", "u", "v", "texture_u", "texture_v"}) && !texture_.empty();
  }
  bool Holds(const FaceAttribute& attribute) const override {
    if (attribute.name == "texcoord") return corner_texture_.any();
    if (attribute.name == "normal") return corner_normals_.any();
    for (size_t s = 0; s < kObjStatements.size(); ++s) {
      if (attribute.name == kObjStatements[s].attribute) return !statements_[s].empty();
    }
    return false;
  }
  size_t RemarksLost() const override { return remarks_.others(); }
  uint64_t PayloadsLost() const override {
    uint64_t lost = corner_texture_.payloads_lost() + corner_normals_.payloads_lost();
    for (const auto* columns : {&colours_, &normals_, &texture_}) {
      for (const TextColumn& column : *columns) lost += column.payloads_lost();
    }
    return lost;
  }

  void WriteVertices(std::span<const double> xyz, std::span<const uint8_t> attributes) override {
    const size_t stride = shape().schema.Stride();
    for (size_t i = 0; i < xyz.size(); i += 3, attributes = attributes.subspan(stride)) {
      vertices().Add("v ");
      AddPosition(xyz.subspan(i, 3));
      for (TextColumn& column : colours_) {
        vertices().Add(" ");
        vertices().Add(column.PartText(attributes));
      }
      vertices().Add("\n");
      AddLine("vt", attributes, texture_);
      AddLine("vn", attributes, normals_);
    }
  }

  void AddLine(std::string_view keyword, std::span<const uint8_t> attributes,
               std::vector<TextColumn>& columns) {
    if (columns.empty()) return;
    vertices().Add(keyword);
    for (TextColumn& column : columns) {
      vertices().Add(" ");
      vertices().Add(column.Text(attributes));
    }
    vertices().Add("\n");
  }

  void WritePolygon(std::span<const uint64_t> corners, const FaceValues& values) override {
    WriteStatements(values.face);
    const size_t corner_bytes = shape().face_schema.CornerBytes();
    texture_numbers_.clear();
    normal_numbers_.clear();
    for (size_t i = 0; i < corners.size(); ++i) {
      const auto corner = values.corners.empty()
                              ? values.corners
                              : values.corners.subspan(i * corner_bytes, corner_bytes);
      const uint64_t of_vertex = corners[i] + 1;
      texture_numbers_.push_back(corner_texture_.any() ? corner_texture_.NumberOf(corner, faces())
                                                       : (texture_.empty() ? 0 : of_vertex));
      normal_numbers_.push_back(corner_normals_.any() ? corner_normals_.NumberOf(corner, faces())
                                                      : (normals_.empty() ? 0 : of_vertex));
    }
    faces().Add("f");
    for (size_t i = 0; i < corners.size(); ++i) {
      AddNumber(" ", corners[i] + 1);
      const uint64_t texture = texture_numbers_[i], normal = normal_numbers_[i];
      if (texture > 0) AddNumber("/", texture);
      if (normal > 0) AddNumber(texture > 0 ? "/" : "//", normal);
    }
    faces().Add("\n");
  }

  /// Of those that are not as at the face before.
  void WriteStatements(std::span<const uint8_t> face) {
    for (size_t s = 0; s < statements_.size(); ++s) {
      if (statements_[s].empty()) continue;
      const auto number = static_cast<uint32_t>(static_cast<int64_t>(statements_[s][0].Real(face)));
      if (number == state_[s]) continue;
      state_[s] = number;
      std::string line(kObjStatements[s].keyword);
      const std::string_view name = remarks_.NameOf(s, number);
      if (!name.empty()) {
        line += ' ';
        line += name;
      } else if (!remarks_.HasNames(s)) {
        line += ' ';
        line += std::to_string(number);
      }
      faces().Add(line);
      faces().Add("\n");
    }
  }

  ObjRemarks remarks_;
  std::vector<TextColumn> colours_, normals_, texture_;  ///< of vertices
  CornerLines corner_texture_, corner_normals_;
  std::vector<uint64_t> texture_numbers_, normal_numbers_;  ///< of the face at hand; 0: none
  std::vector<std::vector<TextColumn>> statements_;         ///< one column each, or none
  ObjState state_{};
};

}  // namespace

std::unique_ptr<MeshWriter> MakeObjWriter(const std::string& path, const MeshShape& shape,
                                          bool force) {
  return std::make_unique<ObjWriter>(path, shape, force);
}

}  // namespace folprom::io
