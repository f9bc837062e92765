// Where decoded parts go: a mesh file, the part of it inside a box, or a digest.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/decode_pipeline.h"
#include "engine/mesh/lattice.h"
#include "io/container/file_table.h"
#include "io/formats/mesh_writer.h"
#include "io/spill/spill.h"

namespace folprom {

/// Writes every part straight to its place in the output.
class FileSink final : public MeshSink {
 public:
  /// expected: counts for which the writer was made. More, or at the end fewer, is kCorrupt;
  /// `input` is the file that the message names.
  FileSink(const Lattice& lattice, const io::LayerRecord& expected, std::string input,
           io::MeshWriter& writer)
      : lattice_(lattice), expected_(expected), input_(std::move(input)), writer_(writer) {}
  void CheckComplete() const;
  void AddSubtree(const SubtreePart& part) override;
  void AddSeam(std::span<const SeamFace> faces) override;
  uint64_t vertices() const { return vertices_; }
  uint64_t faces() const { return faces_; }

 private:
  void Flush();
  Lattice lattice_;
  io::LayerRecord expected_;
  std::string input_;
  io::MeshWriter& writer_;
  uint64_t vertices_ = 0, faces_ = 0;
  std::vector<std::vector<uint64_t>> border_;  ///< per subtree: output index of each border set
  std::vector<double> xyz_;
  std::vector<io::Triangle> triangles_;
};

/// Writes the faces of a soup, each with three vertices of its own.
class SoupSink final : public MeshSink {
 public:
  /// expected, input: as of FileSink; the writer was made for three vertices a face.
  SoupSink(const Lattice& lattice, const io::LayerRecord& expected, std::string input,
           io::MeshWriter& writer)
      : lattice_(lattice), expected_(expected), input_(std::move(input)), writer_(writer) {}
  void CheckComplete() const;
  void AddSubtree(const SubtreePart& part) override;
  void AddSeam(std::span<const SeamFace> faces) override;

 private:
  void AddCorner(const ExactPosition& xyz) { xyz_.insert(xyz_.end(), xyz.begin(), xyz.end()); }
  void Flush();
  Lattice lattice_;
  io::LayerRecord expected_;
  std::string input_;
  io::MeshWriter& writer_;
  uint64_t vertices_ = 0;  ///< of the mesh that is decoded
  uint64_t faces_ = 0;
  std::vector<std::vector<ExactPosition>> border_;  ///< per subtree
  std::vector<double> xyz_;                         ///< of whole faces
};

/// The faces from `first` on of a soup.
std::vector<io::Triangle> SoupFaces(uint64_t first, size_t count);

/// Keeps the vertices inside a box and the faces with all corners inside; their number is known
/// only at the end, so they wait in the spill.
class RegionSink final : public MeshSink {
 public:
  /// attribute_bytes: of a vertex.
  RegionSink(const Lattice& lattice, std::array<double, 3> lo, std::array<double, 3> hi,
             size_t attribute_bytes, const io::SpillDirectory& spill);
  void AddSubtree(const SubtreePart& part) override;
  /// Only where a vertex of its border is inside.
  bool WantsFacesAcross(uint32_t subtree) const override;
  void AddSeam(std::span<const SeamFace> faces) override;
  uint64_t vertices() const { return vertices_; }
  uint64_t faces() const { return faces_; }
  /// Ends the collection and appends everything to the writer.
  void WriteTo(io::MeshWriter& writer);

 private:
  void Keep(const io::Triangle& face);
  Lattice lattice_;
  std::array<double, 3> lo_, hi_;
  size_t attribute_bytes_;
  io::SpillStreams streams_;  ///< 0: positions, 1: faces, 2: attributes
  uint64_t vertices_ = 0, faces_ = 0;
  std::vector<std::vector<uint64_t>> border_;
  std::vector<uint64_t> index_;
};

class DigestSink final : public MeshSink {
 public:
  explicit DigestSink(const Lattice& lattice) : lattice_(lattice) {}
  void AddSubtree(const SubtreePart& part) override;
  void AddSeam(std::span<const SeamFace> faces) override;
  const io::MeshDigest& digest() const { return digest_; }
  uint64_t vertices() const { return vertices_; }
  uint64_t faces() const { return faces_; }

 private:
  Lattice lattice_;
  io::MeshDigest digest_;
  uint64_t vertices_ = 0, faces_ = 0;
  std::vector<std::vector<Int3>> border_;
  std::vector<std::vector<ExactPosition>> exact_border_;  ///< instead, of an exact lattice
};

}  // namespace folprom
