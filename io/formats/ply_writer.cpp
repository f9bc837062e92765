// Binary little-endian PLY: `x y z` as float or double among the attributes of the vertices,
// `property list uchar int vertex_indices` (uint where the vertex count needs it). Vertices and
// faces go to their own offsets.
#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "folprom/float_bits.h"
#include "io/formats/counted_writer.h"
#include "io/formats/output_buffer.h"
#include "io/formats/store_bytes.h"

namespace folprom::io {
namespace {

constexpr uint64_t kFaceBytes = 1 + 3 * sizeof(uint32_t);

/// As other programs call it.
const char* PlyName(ScalarType type) {
  static constexpr std::array<const char*, kScalarTypes> kNames{"char", "uchar", "short", "ushort",
                                                                "int",  "uint",  "float", "double"};
  return kNames[static_cast<size_t>(type)];
}

/// Does the number of items of a list need more than a byte.
bool HasLongLists(const MeshShape& shape, uint64_t per_corner) {
  return shape.largest_face * per_corner > std::numeric_limits<uint8_t>::max();
}
const char* CountName(const MeshShape& shape, uint64_t per_corner) {
  return HasLongLists(shape, per_corner) ? "uint " : "uchar ";
}

std::string FaceProperties(const MeshShape& shape) {
  const bool needs_uint = shape.vertices > uint64_t{std::numeric_limits<int32_t>::max()};
  const std::vector<FaceAttribute>& attributes = shape.face_schema.attributes;
  std::string lines;
  for (size_t i = 0; i <= attributes.size(); ++i) {
    if (i == shape.face_schema.before_indices) {
      lines += std::string("property list ") + CountName(shape, 1) + (needs_uint ? "uint" : "int") +
               " vertex_indices\n";
    }
    if (i == attributes.size()) break;
    const FaceAttribute& attribute = attributes[i];
    lines += "property ";
    if (attribute.per_corner > 0) {
      lines += std::string("list ") + CountName(shape, attribute.per_corner);
    }
    lines += std::string(PlyName(attribute.type)) + " " + attribute.name + "\n";
  }
  return lines;
}

std::string Header(const MeshShape& shape) {
  const std::string type = shape.coordinate_type == ScalarType::kFloat64 ? "double" : "float";
  std::string header = "ply\nformat binary_little_endian 1.0\n";
  for (const std::string& remark : shape.remarks) header += remark + "\n";
  header += "element vertex " + std::to_string(shape.vertices) + "\n";
  const std::vector<VertexAttribute>& attributes = shape.schema.attributes;
  for (size_t i = 0; i <= attributes.size(); ++i) {
    if (i == shape.schema.before_position) {
      for (const char* name : {"x", "y", "z"}) header += "property " + type + " " + name + "\n";
    }
    if (i == attributes.size()) break;
    header +=
        std::string("property ") + PlyName(attributes[i].type) + " " + attributes[i].name + "\n";
  }
  return header + "element face " + std::to_string(shape.faces) + "\n" + FaceProperties(shape) +
         "end_header\n";
}

/// Bytes of the attributes before the position.
size_t BytesBefore(const VertexSchema& schema) {
  size_t bytes = 0;
  for (size_t i = 0; i < schema.before_position; ++i) {
    bytes += ScalarSize(schema.attributes[i].type);
  }
  return bytes;
}

class PlyWriter final : public CountedWriter {
 public:
  PlyWriter(const std::string& path, const MeshShape& shape, bool force)
      : CountedWriter(path, shape, force),
        is_double_(shape.coordinate_type == ScalarType::kFloat64),
        before_(BytesBefore(shape.schema)),
        stride_(shape.schema.Stride()),
        vertices_([this](std::span<const uint8_t> bytes) { WriteAt(&vertex_offset_, bytes); }),
        faces_([this](std::span<const uint8_t> bytes) { WriteAt(&face_offset_, bytes); }) {
    const std::string header = Header(shape);
    file().Append({reinterpret_cast<const uint8_t*>(header.data()), header.size()}).value();
    vertex_offset_ = header.size();
    const uint64_t position_bytes = 3 * (is_double_ ? sizeof(double) : sizeof(float));
    face_offset_ = vertex_offset_ + shape.vertices * (position_bytes + stride_);
  }

 private:
  bool Holds(const VertexAttribute&) const override { return true; }
  bool Holds(const FaceAttribute&) const override { return true; }
  size_t RemarksLost() const override { return 0; }

  void WriteVertices(std::span<const double> xyz, std::span<const uint8_t> attributes) override {
    for (size_t i = 0; i < xyz.size(); i += 3, attributes = attributes.subspan(stride_)) {
      WriteBytes(attributes.first(before_));
      for (const double value : xyz.subspan(i, 3)) {
        if (is_double_) {
          StoreLittleEndian(value, vertices_.Extend(sizeof value));
        } else {
          StoreLittleEndian(NarrowToFloatBits(value), vertices_.Extend(sizeof(float)));
        }
      }
      WriteBytes(attributes.first(stride_).subspan(before_));
    }
  }

  void WriteBytes(std::span<const uint8_t> bytes) {
    if (!bytes.empty()) std::ranges::copy(bytes, vertices_.Extend(bytes.size()));
  }

  void WriteFaces(std::span<const Triangle> faces) override {
    for (const Triangle& face : faces) {
      uint8_t* to = faces_.Extend(kFaceBytes);
      *to++ = 3;
      for (const uint64_t index : face) to = StoreLittleEndian(static_cast<uint32_t>(index), to);
    }
  }

  void WritePolygon(std::span<const uint64_t> corners, const FaceValues& values) override {
    const FaceSchema& schema = shape().face_schema;
    const size_t corner_bytes = schema.CornerBytes();
    size_t of_face = 0, of_corner = 0;
    for (size_t i = 0; i <= schema.attributes.size(); ++i) {
      if (i == schema.before_indices) WriteIndices(corners);
      if (i == schema.attributes.size()) break;
      const FaceAttribute& attribute = schema.attributes[i];
      if (attribute.per_corner == 0) {
        std::ranges::copy(values.face.subspan(of_face, attribute.bytes()),
                          faces_.Extend(attribute.bytes()));
        of_face += attribute.bytes();
        continue;
      }
      WriteCount(corners.size() * attribute.per_corner,
                 HasLongLists(shape(), attribute.per_corner));
      for (size_t at = of_corner; at < values.corners.size(); at += corner_bytes) {
        std::ranges::copy(values.corners.subspan(at, attribute.bytes()),
                          faces_.Extend(attribute.bytes()));
      }
      of_corner += attribute.bytes();
    }
  }

  void WriteIndices(std::span<const uint64_t> corners) {
    WriteCount(corners.size(), HasLongLists(shape(), 1));
    for (const uint64_t index : corners) {
      StoreLittleEndian(static_cast<uint32_t>(index), faces_.Extend(sizeof(uint32_t)));
    }
  }

  void WriteCount(size_t count, bool is_long) {
    if (is_long) {
      StoreLittleEndian(static_cast<uint32_t>(count), faces_.Extend(sizeof(uint32_t)));
    } else {
      *faces_.Extend(1) = static_cast<uint8_t>(count);
    }
  }

  void Finish() override {
    vertices_.Flush();
    faces_.Flush();
  }

  void WriteAt(uint64_t* offset, std::span<const uint8_t> bytes) {
    file().WriteAt(*offset, bytes).value();
    *offset += bytes.size();
  }

  bool is_double_;
  size_t before_, stride_;  ///< bytes of the attributes before the position, and of all
  uint64_t vertex_offset_ = 0, face_offset_ = 0;
  OutputBuffer vertices_, faces_;
};

}  // namespace

std::unique_ptr<MeshWriter> MakePlyWriter(const std::string& path, const MeshShape& shape,
                                          bool force) {
  if (shape.vertices > std::numeric_limits<uint32_t>::max()) {
    throw Failure(ErrorKind::kLimit, path + ": " + std::to_string(shape.vertices) +
                                         " vertices are more than a PLY file can index (2^32-1)");
  }
  if (shape.faces > std::numeric_limits<int64_t>::max() / (2 * kFaceBytes)) {
    throw Failure(ErrorKind::kLimit, path + ": " + std::to_string(shape.faces) +
                                         " faces are more than a file can hold");
  }
  return std::make_unique<PlyWriter>(path, shape, force);
}

}  // namespace folprom::io
