#include "ply_builder.h"

#include <algorithm>
#include <cstdio>

#include "io/formats/ply_scalar.h"

namespace folprom::io::testing {

PlyBuilder::PlyBuilder(PlyFormat format) : format_(format) {
  static constexpr std::string_view kNames[] = {"ascii", "binary_little_endian",
                                                "binary_big_endian"};
  Header("ply").Header("format " + std::string(kNames[static_cast<size_t>(format)]) + " 1.0");
}

PlyBuilder& PlyBuilder::Header(std::string_view line) {
  bytes_ += line;
  bytes_ += '\n';
  return *this;
}

PlyBuilder& PlyBuilder::Body() { return Header("end_header"); }

PlyBuilder& PlyBuilder::Value(ScalarType type, double value) {
  if (format_ == PlyFormat::kAscii) {
    char text[40];
    std::snprintf(text, sizeof text, "%s%.17g", line_begins_ ? "" : " ", value);
    bytes_ += text;
    line_begins_ = false;
    return *this;
  }
  WithScalarType(type, [&]<class T>(T) {
    const T typed = static_cast<T>(value);
    char raw[sizeof(T)];
    std::memcpy(raw, &typed, sizeof raw);
    const bool big = format_ == PlyFormat::kBinaryBigEndian;
    if (big != (std::endian::native == std::endian::big)) std::reverse(raw, raw + sizeof raw);
    bytes_.append(raw, sizeof raw);
  });
  return *this;
}

PlyBuilder& PlyBuilder::List(ScalarType count_type, ScalarType type,
                             const std::vector<double>& items) {
  Value(count_type, static_cast<double>(items.size()));
  for (const double item : items) Value(type, item);
  return *this;
}

PlyBuilder& PlyBuilder::End() {
  if (format_ == PlyFormat::kAscii) bytes_ += '\n';
  line_begins_ = true;
  return *this;
}

std::string TypeName(ScalarType type, bool second_family) {
  static const std::string kNames[2][8] = {
      {"char", "uchar", "short", "ushort", "int", "uint", "float", "double"},
      {"int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"}};
  return kNames[second_family ? 1 : 0][static_cast<size_t>(type)];
}

std::string MixedFile(PlyFormat format) {
  using enum ScalarType;
  PlyBuilder ply(format);
  ply.Header("comment made for a test").Header("obj_info one").Header("element camera 1");
  ply.Header("property list int float matrix").Header("property short view");
  ply.Header("element vertex 4").Header("property uchar quality").Header("property float x");
  ply.Header("property double y").Header("property int z").Header("property list char short tags");
  ply.Header("element edge 2").Header("property int vertex1").Header("property int vertex2");
  ply.Header("element face 3").Header("property float area");
  ply.Header("property list uchar int vertex_indices").Header("property uchar red");
  ply.Header("element tail 2").Header("property list uint double weights").Body();

  ply.List(kInt32, kFloat32, {1, 0.5, 0.25}).Value(kInt16, -3).End();
  const std::vector<double> xyz = MixedPositions();
  for (size_t v = 0; v < 4; ++v) {
    ply.Value(kUint8, 200).Value(kFloat32, xyz[3 * v]).Value(kFloat64, xyz[3 * v + 1]);
    ply.Value(kInt32, xyz[3 * v + 2]).List(kInt8, kInt16, std::vector<double>(v, -7)).End();
  }
  ply.Value(kInt32, 0).Value(kInt32, 1).End().Value(kInt32, 1).Value(kInt32, 2).End();
  const std::vector<double> faces[] = {{2, 0, 1}, {0, 3}, {3, 2, 1, 0}};
  for (const std::vector<double>& face : faces) {
    ply.Value(kFloat32, 0.5).List(kUint8, kInt32, face).Value(kUint8, 9).End();
  }
  ply.List(kUint32, kFloat64, {}).End().List(kUint32, kFloat64, {2, 3}).End();
  return ply.bytes();
}

std::vector<double> MixedPositions() {
  return {0.5, 0.1, -1, -2.25, 1e300, 70000, 3, -0.3, 0, 1024.125, 1, -70000};
}

std::vector<Triangle> MixedTriangles() { return {{2, 0, 1}, {3, 2, 1}, {3, 1, 0}}; }

}  // namespace folprom::io::testing
