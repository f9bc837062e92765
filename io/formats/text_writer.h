// What the writers of OBJ and OFF have in common: a line a vertex, then a line a face. Faces wait
// in a scratch file for the last vertex.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/scratch_file.h"
#include "io/formats/counted_writer.h"
#include "io/formats/decimal_writer.h"
#include "io/formats/output_buffer.h"

namespace folprom::io {

/// A column of attributes as text.
class TextColumn {
 public:
  TextColumn(ScalarType type, size_t offset) : type_(type), offset_(offset), decimals_(type) {}
  /// Of the values of a vertex, a face or a corner. Valid until the next call.
  std::string_view Text(std::span<const uint8_t> values);
  /// The same of a value of 0 .. 255 that the format has as a part of 1.
  std::string_view PartText(std::span<const uint8_t> values);
  ScalarType type() const { return type_; }
  double Real(std::span<const uint8_t> values) const;
  uint64_t payloads_lost() const { return decimals_.payloads_lost(); }

 private:
  ScalarType type_;
  size_t offset_;
  DecimalWriter decimals_;
  std::string text_;
};

/// The columns of these names, in this order; nothing unless all are there and of one type.
std::vector<TextColumn> ColumnsNamed(const VertexSchema& schema,
                                     std::span<const std::string_view> names);
/// The same of numbers of faces.
std::vector<TextColumn> ColumnsNamed(const FaceSchema& schema,
                                     std::span<const std::string_view> names);
/// red, green and blue, with alpha where it is there, if they are bytes or floats.
template <class Schema>
std::vector<TextColumn> ColourColumns(const Schema& schema) {
  constexpr std::string_view kNames[] = {"red", "green", "blue", "alpha"};
  std::vector<TextColumn> columns = ColumnsNamed(schema, kNames);
  if (columns.empty()) columns = ColumnsNamed(schema, std::span(kNames).first(3));
  const bool fits =
      columns.empty() || IsFloat(columns[0].type()) || columns[0].type() == ScalarType::kUint8;
  return fits ? columns : std::vector<TextColumn>();
}

class TextWriter : public CountedWriter {
 public:
  std::vector<std::string> Warnings() const override;

 protected:
  TextWriter(const std::string& path, const MeshShape& shape, bool force, const char* name);

  /// "x y z", without an end.
  void AddPosition(std::span<const double> xyz);
  void AddNumber(std::string_view before, uint64_t number);
  /// What WriteVertices and WritePolygon write to.
  OutputBuffer& vertices() { return vertices_; }
  OutputBuffer& faces() { return faces_; }
  /// NaN whose payload is lost, beside those of the positions.
  virtual uint64_t PayloadsLost() const = 0;

 private:
  void WriteFaces(std::span<const Triangle> triangles) override {
    for (const Triangle& triangle : triangles) WritePolygon(triangle, {});
  }
  void Finish() override;

  const char* name_;
  DecimalWriter decimals_;
  ScratchFile face_file_;
  OutputBuffer vertices_, faces_;
};

}  // namespace folprom::io
