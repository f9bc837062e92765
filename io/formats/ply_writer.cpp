// Binary little-endian PLY: `x y z` as float or double, `property list uchar int vertex_indices`
// (uint where the vertex count needs it). Vertices and faces go to their own offsets.
#include <limits>
#include <string>

#include "folprom/float_bits.h"
#include "io/formats/counted_writer.h"
#include "io/formats/output_buffer.h"
#include "io/formats/store_bytes.h"

namespace folprom::io {
namespace {

constexpr uint64_t kFaceBytes = 1 + 3 * sizeof(uint32_t);

std::string Header(const MeshShape& shape) {
  const std::string type = shape.coordinate_type == ScalarType::kFloat64 ? "double" : "float";
  const bool needs_uint = shape.vertices > uint64_t{std::numeric_limits<int32_t>::max()};
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(shape.vertices) +
         "\nproperty " + type + " x\nproperty " + type + " y\nproperty " + type +
         " z\nelement face " + std::to_string(shape.faces) + "\nproperty list uchar " +
         (needs_uint ? "uint" : "int") + " vertex_indices\nend_header\n";
}

class PlyWriter final : public CountedWriter {
 public:
  PlyWriter(const std::string& path, const MeshShape& shape, bool force)
      : CountedWriter(path, shape, force),
        is_double_(shape.coordinate_type == ScalarType::kFloat64),
        vertices_([this](std::span<const uint8_t> bytes) { WriteAt(&vertex_offset_, bytes); }),
        faces_([this](std::span<const uint8_t> bytes) { WriteAt(&face_offset_, bytes); }) {
    const std::string header = Header(shape);
    file().Append({reinterpret_cast<const uint8_t*>(header.data()), header.size()}).value();
    vertex_offset_ = header.size();
    face_offset_ =
        vertex_offset_ + shape.vertices * 3 * (is_double_ ? sizeof(double) : sizeof(float));
  }

 private:
  void WriteVertices(std::span<const double> xyz) override {
    for (const double value : xyz) {
      if (is_double_) {
        StoreLittleEndian(value, vertices_.Extend(sizeof value));
      } else {
        StoreLittleEndian(NarrowToFloatBits(value), vertices_.Extend(sizeof(float)));
      }
    }
  }

  void WriteFaces(std::span<const Triangle> faces) override {
    for (const Triangle& face : faces) {
      uint8_t* to = faces_.Extend(kFaceBytes);
      *to++ = 3;
      for (const uint64_t index : face) to = StoreLittleEndian(static_cast<uint32_t>(index), to);
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
