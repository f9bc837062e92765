#include "io/formats/text_writer.h"

#include <algorithm>
#include <charconv>

#include "folprom/float_bits.h"
#include "io/formats/ply_scalar.h"

namespace folprom::io {
namespace {

/// attributes: all, of which the matching ones take so many bytes one behind the other.
template <class Attribute, class Matches, class Bytes>
std::vector<TextColumn> Columns(const std::vector<Attribute>& attributes,
                                std::span<const std::string_view> names, Matches matches,
                                Bytes bytes) {
  std::vector<TextColumn> columns;
  for (const std::string_view name : names) {
    size_t offset = 0;
    for (const Attribute& attribute : attributes) {
      if (!matches(attribute)) continue;
      if (attribute.name == name) {
        if (!columns.empty() && attribute.type != columns[0].type()) return {};
        columns.emplace_back(attribute.type, offset);
      }
      offset += bytes(attribute);
    }
  }
  return columns.size() == names.size() ? columns : std::vector<TextColumn>();
}

}  // namespace

double TextColumn::Real(std::span<const uint8_t> values) const {
  return WithScalarType(
      type_, [&]<class T>(T) { return ToDouble(Load<T, false>(values.data() + offset_)); });
}

std::string_view TextColumn::Text(std::span<const uint8_t> values) {
  if (IsFloat(type_)) return decimals_.Text(Real(values));
  text_ = std::to_string(static_cast<int64_t>(Real(values)));
  return text_;
}

std::string_view TextColumn::PartText(std::span<const uint8_t> values) {
  if (type_ != ScalarType::kUint8) return Text(values);
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, static_cast<float>(Real(values)) / 255);
  text_.assign(text, end.ptr);
  return text_;
}

std::vector<TextColumn> ColumnsNamed(const VertexSchema& schema,
                                     std::span<const std::string_view> names) {
  return Columns(
      schema.attributes, names, [](const VertexAttribute&) { return true; },
      [](const VertexAttribute& attribute) { return ScalarSize(attribute.type); });
}

std::vector<TextColumn> ColumnsNamed(const FaceSchema& schema,
                                     std::span<const std::string_view> names) {
  return Columns(
      schema.attributes, names,
      [](const FaceAttribute& attribute) { return attribute.per_corner == 0; },
      [](const FaceAttribute& attribute) { return attribute.bytes(); });
}

TextWriter::TextWriter(const std::string& path, const MeshShape& shape, bool force,
                       const char* name)
    : CountedWriter(path, shape, force),
      name_(name),
      decimals_(shape.coordinate_type),
      face_file_(file().folder(), path),
      vertices_([this](std::span<const uint8_t> bytes) { file().Append(bytes).value(); }),
      faces_([this](std::span<const uint8_t> bytes) { face_file_.Append(bytes); }) {}

std::vector<std::string> TextWriter::Warnings() const {
  std::vector<std::string> warnings = CountedWriter::Warnings();
  const uint64_t lost = decimals_.payloads_lost() + PayloadsLost();
  if (lost > 0) {
    warnings.push_back(std::string(name_) + " holds text: " + std::to_string(lost) +
                       " NaN lose their payload");
  }
  return warnings;
}

void TextWriter::AddPosition(std::span<const double> xyz) {
  for (size_t axis = 0; axis < 3; ++axis) {
    if (axis > 0) vertices_.Add(" ");
    vertices_.Add(decimals_.Text(xyz[axis]));
  }
}

void TextWriter::AddNumber(std::string_view before, uint64_t number) {
  char text[24];
  const auto end = std::to_chars(text, text + sizeof text, number);
  faces_.Add(before);
  faces_.Add({text, static_cast<size_t>(end.ptr - text)});
}

void TextWriter::Finish() {
  vertices_.Flush();
  faces_.Flush();
  file().AppendFrom(face_file_).value();
}

}  // namespace folprom::io
