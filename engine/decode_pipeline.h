// Decodes layers of a file in parallel and hands the parts on in a fixed order.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/codec/parameters.h"
#include "engine/codec/seam_coder.h"
#include "engine/mesh/lattice.h"
#include "engine/mesh/types.h"
#include "io/container/reader.h"
#include "io/spill/spill.h"
#include "parallel/progress.h"
#include "parallel/runner.h"

namespace folprom {

/// A decoded subtree.
struct SubtreePart {
  uint32_t subtree = 0;
  std::span<const Int3> positions;
  std::span<const ExactPosition> exact;  ///< of the same, where they are not on the lattice
  std::span<const Face> faces;
  /// Vertex of each border set; by these sets the seams name their corners.
  std::span<const uint32_t> border_vertices;
  /// Vertex by vertex as the scan has them; empty where the file has none.
  std::span<const uint8_t> attributes = {};

  /// Model units.
  ExactPosition Position(const Lattice& lattice, size_t vertex) const {
    return exact.empty() ? lattice.ToModel(positions[vertex]) : exact[vertex];
  }
};

/// Receives the parts of a mesh one at a time: subtrees in ascending order, then seams.
class MeshSink {
 public:
  virtual ~MeshSink() = default;
  virtual void AddSubtree(const SubtreePart& part) = 0;
  /// After AddSubtree: could a face between this subtree and others be wanted.
  virtual bool WantsFacesAcross(uint32_t /*subtree*/) const { return true; }
  virtual void AddSeam(std::span<const SeamFace> faces) = 0;
};

/// What to decode.
struct DecodeSelection {
  size_t layers = 0;             ///< at least 1
  std::vector<uint32_t> wanted;  ///< subtrees to hand on, ascending; seams between them come too
};

std::vector<uint32_t> AllSubtrees(const io::FileTable& table);
/// Every subtree that may have a representative in [lo, hi] (lattice coordinates as doubles) in the
/// LOD of `layers` layers.
std::vector<uint32_t> SubtreesInBox(const io::FileTable& table, size_t layers, const double* lo,
                                    const double* hi);
/// What a decoding read.
struct DecodedSegments {
  std::vector<uint32_t> subtrees;  ///< wanted ones, and those that only seams needed
  std::vector<uint32_t> seams;     ///< by owner
};
/// Bytes of the tables and of these segments in the first `layers` layers. To check them whole
/// groups are read, and their checksums, which do not count here.
uint64_t BytesOf(const io::ContainerReader& container, size_t layers,
                 const DecodedSegments& segments);

/// Peak memory follows `memory_bytes` and the largest subtree, not the mesh: border records wait in
/// a spill folder below `temporary_folder`. A seam is decoded where it may give a wanted face:
/// where the sink wants faces across of its owner and of a lower neighbour. It needs all lower
/// neighbours.
DecodedSegments DecodeInto(const io::ContainerReader& container, const CodecParameters& parameters,
                           const DecodeSelection& selection, uint64_t memory_bytes,
                           const std::string& temporary_folder, parallel::Runner& runner,
                           parallel::Progress& progress, MeshSink& sink);

}  // namespace folprom
