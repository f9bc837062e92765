#include "io/formats/ply_writer.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>
#include <vector>

#include "folprom/float_bits.h"
#include "io/files/atomic_file.h"

namespace folprom::io {
namespace {

constexpr size_t kBufferBytes = size_t{1} << 20;
constexpr uint64_t kFaceBytes = 1 + 3 * sizeof(uint32_t);

/// Bytes that go to consecutive offsets of the file, in large pieces.
class Section {
 public:
  Section(AtomicFile& file, uint64_t offset) : file_(file), offset_(offset) {
    buffer_.reserve(kBufferBytes);
  }

  /// Room for `size` bytes at the end of the buffer, which is written out before where it is full.
  uint8_t* Extend(size_t size) {
    if (buffer_.size() + size > kBufferBytes) Flush();
    buffer_.resize(buffer_.size() + size);
    return buffer_.data() + buffer_.size() - size;
  }

  void Flush() {
    file_.WriteAt(offset_, buffer_).value();
    offset_ += buffer_.size();
    buffer_.clear();
  }

 private:
  AtomicFile& file_;
  uint64_t offset_;
  std::vector<uint8_t> buffer_;
};

template <class T>
uint8_t* StoreLittleEndian(T value, uint8_t* to) {
  const auto bytes = std::bit_cast<std::array<uint8_t, sizeof(T)>>(value);
  if constexpr (std::endian::native == std::endian::little) {
    return std::copy(bytes.begin(), bytes.end(), to);
  } else {
    return std::copy(bytes.rbegin(), bytes.rend(), to);
  }
}

std::string Header(uint64_t vertex_count, uint64_t face_count, bool is_double) {
  const std::string type = is_double ? "double" : "float";
  const bool needs_uint = vertex_count > uint64_t{std::numeric_limits<int32_t>::max()};
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(vertex_count) +
         "\nproperty " + type + " x\nproperty " + type + " y\nproperty " + type +
         " z\nelement face " + std::to_string(face_count) + "\nproperty list uchar " +
         (needs_uint ? "uint" : "int") + " vertex_indices\nend_header\n";
}

class PlyWriterOnDisk final : public PlyWriter {
 public:
  PlyWriterOnDisk(const std::string& path, uint64_t vertex_count, uint64_t face_count,
                  bool is_double, std::unique_ptr<AtomicFile> file, uint64_t header_bytes)
      : path_(path),
        vertices_left_(vertex_count),
        faces_left_(face_count),
        vertex_count_(vertex_count),
        is_double_(is_double),
        file_(std::move(file)),
        vertices_(*file_, header_bytes),
        faces_(*file_,
               header_bytes + vertex_count * 3 * (is_double ? sizeof(double) : sizeof(float))) {}

  Result<void> AppendVertices(std::span<const double> xyz) override {
    return Guarded([&] {
      if (xyz.size() % 3 != 0 || xyz.size() / 3 > vertices_left_) {
        ThrowInternal("more vertices are written than were announced");
      }
      vertices_left_ -= xyz.size() / 3;
      for (const double value : xyz) {
        if (is_double_) {
          StoreLittleEndian(value, vertices_.Extend(sizeof value));
        } else {
          StoreLittleEndian(NarrowToFloatBits(value), vertices_.Extend(sizeof(float)));
        }
      }
    });
  }

  Result<void> AppendFaces(std::span<const Triangle> faces) override {
    return Guarded([&] {
      if (faces.size() > faces_left_) ThrowInternal("more faces are written than were announced");
      faces_left_ -= faces.size();
      for (const Triangle& face : faces) {
        uint8_t* to = faces_.Extend(kFaceBytes);
        *to++ = 3;
        for (const uint64_t index : face) {
          if (index >= vertex_count_) ThrowInternal("a face has an index beyond the vertices");
          to = StoreLittleEndian(static_cast<uint32_t>(index), to);
        }
      }
    });
  }

  Result<void> Commit() override {
    return Guarded([&] {
      if (vertices_left_ != 0 || faces_left_ != 0) {
        ThrowInternal("fewer vertices or faces are written than were announced");
      }
      vertices_.Flush();
      faces_.Flush();
      file_->Commit().value();
    });
  }

 private:
  [[noreturn]] void ThrowInternal(const char* reason) const {
    throw Failure(ErrorKind::kInternal, path_ + ": " + reason);
  }

  template <class Work>
  static Result<void> Guarded(Work work) {
    try {
      work();
      return {};
    } catch (const Failure& failure) {
      return failure.error();
    }
  }

  std::string path_;
  uint64_t vertices_left_;
  uint64_t faces_left_;
  uint64_t vertex_count_;
  bool is_double_;
  std::unique_ptr<AtomicFile> file_;
  Section vertices_;
  Section faces_;
};

}  // namespace

Result<std::unique_ptr<PlyWriter>> PlyWriter::Create(const std::string& path, uint64_t vertex_count,
                                                     uint64_t face_count,
                                                     ScalarType coordinate_type, bool force) {
  if (vertex_count > std::numeric_limits<uint32_t>::max()) {
    return Error{ErrorKind::kLimit, path + ": " + std::to_string(vertex_count) +
                                        " vertices are more than a PLY file can index (2^32-1)"};
  }
  if (face_count > std::numeric_limits<int64_t>::max() / (2 * kFaceBytes)) {
    return Error{ErrorKind::kLimit,
                 path + ": " + std::to_string(face_count) + " faces are more than a file can hold"};
  }
  try {
    const bool is_double = coordinate_type == ScalarType::kFloat64;
    const std::string header = Header(vertex_count, face_count, is_double);
    std::unique_ptr<AtomicFile> file = AtomicFile::Create(path, force).value();
    file->Append({reinterpret_cast<const uint8_t*>(header.data()), header.size()}).value();
    return std::unique_ptr<PlyWriter>(std::make_unique<PlyWriterOnDisk>(
        path, vertex_count, face_count, is_double, std::move(file), header.size()));
  } catch (const Failure& failure) {
    return failure.error();
  }
}

}  // namespace folprom::io
