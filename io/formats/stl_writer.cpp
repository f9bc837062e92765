// Binary STL. Facets hold their corners' positions, which may come after the faces: both wait in
// scratch files until all are there.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "folprom/float_bits.h"
#include "io/files/scratch_file.h"
#include "io/formats/counted_writer.h"
#include "io/formats/output_buffer.h"
#include "io/formats/store_bytes.h"

namespace folprom::io {
namespace {

constexpr size_t kHeaderBytes = 84;
constexpr size_t kFacetBytes = 50;
constexpr uint64_t kFacetsBetweenDrops = 1 << 16;
constexpr char kTitle[] = "binary STL by folprom";  // must not begin with "solid"

using FloatBits = std::array<uint32_t, 3>;  // of a position
using Corners = std::array<uint32_t, 3>;

std::array<double, 3> Position(const FloatBits& bits) {
  return {std::bit_cast<float>(bits[0]), std::bit_cast<float>(bits[1]),
          std::bit_cast<float>(bits[2])};
}

/// Of length 1, or zero where the corners span no area.
std::array<float, 3> Normal(const FloatBits& a, const FloatBits& b, const FloatBits& c) {
  const std::array<double, 3> p = Position(a), q = Position(b), r = Position(c);
  std::array<double, 3> u, v;
  for (size_t i = 0; i < 3; ++i) {
    u[i] = q[i] - p[i];
    v[i] = r[i] - p[i];
  }
  const std::array<double, 3> n = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                   u[0] * v[1] - u[1] * v[0]};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  if (!(length > 0) || !std::isfinite(length)) return {0, 0, 0};
  return {static_cast<float>(n[0] / length), static_cast<float>(n[1] / length),
          static_cast<float>(n[2] / length)};
}

/// Positions that are read in any order, with at most about 32 MiB of them resident.
class PositionMap {
 public:
  explicit PositionMap(const ScratchFile& file)
      : map_(file.Map()), touched_((map_.bytes().size() >> kRegionBits) + 1) {}

  FloatBits At(uint64_t vertex) {
    const uint64_t offset = vertex * sizeof(FloatBits);
    FloatBits bits;
    std::memcpy(bits.data(), map_.bytes().data() + offset, sizeof bits);
    if (!touched_[offset >> kRegionBits]) Touch(offset >> kRegionBits);
    return bits;
  }

 private:
  // A touched page brings up to 64 KiB around it along.
  static constexpr int kRegionBits = 16;
  static constexpr uint64_t kMostRegions = 512;

  void Touch(uint64_t region) {
    if (++regions_ > kMostRegions) {
      map_.DropResident();
      touched_.assign(touched_.size(), false);
      regions_ = 1;
    }
    touched_[region] = true;
  }

  MappedFile map_;
  std::vector<bool> touched_;
  uint64_t regions_ = 0;
};

class StlWriter final : public CountedWriter {
 public:
  StlWriter(const std::string& path, const MeshShape& shape, bool force)
      : CountedWriter(path, shape, force),
        position_file_(file().folder(), path),
        face_file_(file().folder(), path),
        positions_([this](std::span<const uint8_t> bytes) { position_file_.Append(bytes); }),
        faces_([this](std::span<const uint8_t> bytes) { face_file_.Append(bytes); }) {}

  std::vector<std::string> Warnings() const override {
    std::vector<std::string> warnings = CountedWriter::Warnings();
    if (!is_soup_ || shape().vertices != 3 * FacetCount()) {
      warnings.push_back(
          "STL holds facets alone: which of them share a vertex is lost, and with it every vertex "
          "of no face");
    }
    if (FacetCount() > shape().faces) {
      warnings.push_back("STL holds triangles alone: " + std::to_string(shape().faces) +
                         " faces are cut into " + std::to_string(FacetCount()));
    }
    if (rounded_ > 0 && shape().coordinate_type == ScalarType::kFloat64) {
      warnings.push_back("STL holds float32: " + std::to_string(rounded_) +
                         " coordinates are rounded");
    }
    return warnings;
  }

 private:
  // Temporary files are in the byte order of the machine.
  void WriteVertices(std::span<const double> xyz, std::span<const uint8_t>) override {
    for (const double value : xyz) {
      const uint32_t bits = NarrowToFloatBits(value);
      rounded_ += std::bit_cast<uint64_t>(WidenFloat(std::bit_cast<float>(bits))) !=
                  std::bit_cast<uint64_t>(value);
      AddValue(bits, positions_);
    }
  }

  void WriteFaces(std::span<const Triangle> faces) override {
    for (const Triangle& face : faces) {
      for (const uint64_t index : face) {
        is_soup_ &= index == corners_++;
        AddValue(static_cast<uint32_t>(index), faces_);
      }
    }
  }

  bool HoldsPolygons() const override { return false; }
  void WritePolygon(std::span<const uint64_t>, const FaceValues&) override {}

  uint64_t FacetCount() const { return shape().triangles > 0 ? shape().triangles : shape().faces; }

  static void AddValue(uint32_t value, OutputBuffer& buffer) {
    std::memcpy(buffer.Extend(sizeof value), &value, sizeof value);
  }

  void Finish() override {
    positions_.Flush();
    faces_.Flush();
    OutputBuffer out([this](std::span<const uint8_t> bytes) { file().Append(bytes).value(); });
    out.Add(kTitle);
    std::fill_n(out.Extend(kHeaderBytes - sizeof(uint32_t) - sizeof kTitle + 1),
                kHeaderBytes - sizeof(uint32_t) - sizeof kTitle + 1, uint8_t{0});
    StoreLittleEndian(static_cast<uint32_t>(FacetCount()), out.Extend(sizeof(uint32_t)));

    PositionMap positions(position_file_);
    const MappedFile faces = face_file_.Map();
    const auto* corners = reinterpret_cast<const Corners*>(faces.bytes().data());
    for (uint64_t f = 0; f < FacetCount(); ++f) {
      const auto& [a, b, c] = corners[f];
      WriteFacet(positions.At(a), positions.At(b), positions.At(c), out.Extend(kFacetBytes));
      if (f % kFacetsBetweenDrops == kFacetsBetweenDrops - 1) faces.DropResident();
    }
    out.Flush();
  }

  static void WriteFacet(const FloatBits& a, const FloatBits& b, const FloatBits& c, uint8_t* to) {
    for (const float value : Normal(a, b, c)) to = StoreLittleEndian(value, to);
    for (const FloatBits& corner : {a, b, c}) {
      for (const uint32_t bits : corner) to = StoreLittleEndian(bits, to);
    }
    StoreLittleEndian(uint16_t{0}, to);
  }

  ScratchFile position_file_, face_file_;
  OutputBuffer positions_, faces_;
  bool is_soup_ = true;  // face i is of the vertices 3i, 3i + 1 and 3i + 2 so far
  uint64_t corners_ = 0;
  uint64_t rounded_ = 0;
};

}  // namespace

std::unique_ptr<MeshWriter> MakeStlWriter(const std::string& path, const MeshShape& shape,
                                          bool force) {
  constexpr uint64_t kMost = std::numeric_limits<uint32_t>::max();
  if (shape.vertices > kMost || std::max(shape.faces, shape.triangles) > kMost) {
    throw Failure(ErrorKind::kLimit, path + ": " + std::to_string(shape.vertices) +
                                         " vertices and " + std::to_string(shape.faces) +
                                         " faces are more than an STL file can count (2^32-1)");
  }
  return std::make_unique<StlWriter>(path, shape, force);
}

}  // namespace folprom::io
