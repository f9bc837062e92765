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

std::string PropertyLine(const VertexAttribute& attribute) {
  static constexpr std::array<const char*, kScalarTypes> kNames{"char", "uchar", "short", "ushort",
                                                                "int",  "uint",  "float", "double"};
  return std::string("property ") + kNames[static_cast<size_t>(attribute.type)] + " " +
         attribute.name + "\n";
}

/// Does the number of corners need more than a byte.
bool HasLongFaces(const MeshShape& shape) {
  return shape.largest_face > std::numeric_limits<uint8_t>::max();
}

std::string Header(const MeshShape& shape) {
  const std::string type = shape.coordinate_type == ScalarType::kFloat64 ? "double" : "float";
  const bool needs_uint = shape.vertices > uint64_t{std::numeric_limits<int32_t>::max()};
  std::string header = "ply\nformat binary_little_endian 1.0\n";
  for (const std::string& remark : shape.remarks) header += remark + "\n";
  header += "element vertex " + std::to_string(shape.vertices) + "\n";
  const std::vector<VertexAttribute>& attributes = shape.schema.attributes;
  for (size_t i = 0; i <= attributes.size(); ++i) {
    if (i == shape.schema.before_position) {
      for (const char* name : {"x", "y", "z"}) header += "property " + type + " " + name + "\n";
    }
    if (i < attributes.size()) header += PropertyLine(attributes[i]);
  }
  return header + "element face " + std::to_string(shape.faces) + "\nproperty list " +
         (HasLongFaces(shape) ? "uint " : "uchar ") + (needs_uint ? "uint" : "int") +
         " vertex_indices\nend_header\n";
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
  bool HoldsAttributes() const override { return true; }

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

  void WritePolygon(std::span<const uint64_t> corners) override {
    const auto count = static_cast<uint32_t>(corners.size());
    if (HasLongFaces(shape())) {
      StoreLittleEndian(count, faces_.Extend(sizeof count));
    } else {
      *faces_.Extend(1) = static_cast<uint8_t>(count);
    }
    for (const uint64_t index : corners) {
      StoreLittleEndian(static_cast<uint32_t>(index), faces_.Extend(sizeof(uint32_t)));
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
