// A whole decoded mesh, given out as its scan had it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/decode_pipeline.h"
#include "engine/mapped_space.h"
#include "engine/mesh/lattice.h"
#include "engine/section_decoder.h"

namespace folprom {

/// Collects a mesh of all layers, on disk; then it can be read in the order of the sections.
class OrderedMesh final : public MeshSink {
 public:
  /// The container has whole sections. Failure kLimit: too many vertices or faces to be ordered.
  OrderedMesh(const io::ContainerReader& container, const Lattice& lattice,
              const io::SpillDirectory& spill, uint64_t memory_bytes);
  void AddSubtree(const SubtreePart& part) override;
  void AddSeam(std::span<const SeamFace> faces) override;
  /// After the last part: decodes the order of the vertices. Throws Failure kCorrupt.
  void Finish();

  /// Replaces both by those of `count` vertices of the scan: coordinates in model units, and the
  /// attributes of each.
  void ReadVertices(uint64_t first, size_t count, std::vector<double>* xyz,
                    std::vector<uint8_t>* attributes);
  /// Of a soup: the same of the corners of these faces, one after another.
  void ReadCorners(std::span<const Face> faces, std::vector<double>* xyz);
  /// The next faces, see SectionDecoder.
  bool ReadFaces(FaceChunk* chunk) { return decoder_->Next(chunk); }

 private:
  void AppendPosition(uint32_t number, std::vector<double>* xyz);
  [[noreturn]] void ThrowCountsDiffer() const;
  void AddFace(const Face& face);
  /// What waits on disk until all is there.
  enum Stream : size_t { kPositions, kExact, kAttributes, kFaces, kStreams };

  const io::ContainerReader& container_;
  const io::FileTable& table_;
  Lattice lattice_;
  MappedSpace space_;
  size_t stride_;   ///< bytes of the attributes of a vertex
  bool has_exact_;  ///< the lattice does not tell all of a position
  io::SpillStreams streams_;
  uint64_t vertices_ = 0, faces_added_ = 0;
  // By the numbers along the curve.
  std::span<const Int3> positions_;
  std::span<const ExactPosition> exact_;  ///< where has_exact_
  std::span<const uint8_t> attributes_;
  std::vector<std::vector<uint32_t>> border_;  ///< per subtree: vertex of each border set
  std::optional<SectionDecoder> decoder_;
};

}  // namespace folprom
