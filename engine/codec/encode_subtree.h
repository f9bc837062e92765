// Encodes one chunk: hierarchy, then every layer.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/codec/border_record.h"
#include "engine/codec/parameters.h"
#include "engine/codec/subtree_coder.h"
#include "engine/hierarchy/set_tree.h"
#include "engine/partition/partition.h"
#include "io/container/file_table.h"

namespace folprom {

/// What the seams and the digest need of a subtree, beside its events.
struct BorderVertices {
  std::vector<uint32_t> original;    ///< vertex of the chunk, per final border set
  std::vector<Int3> position;        ///< decoded position, per final border set
  std::vector<ExactPosition> exact;  ///< the same, of an exact encoding
};

struct EncodedSubtree {
  std::vector<std::vector<uint8_t>> segments;  ///< per layer
  std::vector<double> distance;                ///< largest per layer, lattice units
  std::vector<uint32_t> vertices;              ///< of the LOD per layer
  std::vector<uint64_t> faces;                 ///< of the LOD per layer
  BorderRecord border;
  BorderVertices border_vertices;
  io::MeshDigest digest;  ///< vertices and inner faces
  CostMeters meters;
  std::vector<bool> active;  ///< per layer: did anything change
  /// Index in the decoded subtree of each vertex of the chunk.
  std::vector<uint32_t> final_vertices;
};

/// The hierarchy that the settings ask for.
SetTree BuildSetTree(const SubtreeChunk& chunk, uint32_t subtree,
                     const CodecParameters& parameters);

/// Upper estimate of the memory that EncodeSubtree takes.
uint64_t EncodeSubtreeBytes(const SubtreeSummary& summary, const CodecParameters& parameters);

/// Throws Failure kInternal when a decoded position would miss the tolerance. `meters`: where to
/// start counting, and into which tallies. after_layer, if any, is called after each.
EncodedSubtree EncodeSubtree(const SubtreeChunk& chunk, const SubtreeSummary& summary,
                             uint32_t subtree, const CodecParameters& parameters,
                             const CostMeters& meters = {},
                             const std::function<void(SubtreeCoder&)>& after_layer = {});

struct EncodedSeam {
  std::vector<std::vector<uint8_t>> segments;
  std::vector<uint64_t> faces;  ///< per layer
  io::MeshDigest digest;        ///< cross faces
  uint64_t meter = 0;
  std::vector<bool> active;  ///< per layer
};

struct BorderFile {
  BorderRecord record;
  BorderVertices vertices;
};

/// Estimate of the memory that EncodeSeam takes, its arguments included. border_bytes: of the files
/// of the records.
uint64_t EncodeSeamBytes(uint64_t border_bytes, uint64_t cross_faces);

/// Encodes the seam of an owner from complete records.
EncodedSeam EncodeSeam(const std::vector<uint32_t>& subtrees,
                       const std::vector<BorderFile>& borders,
                       std::span<const CrossFace> cross_faces, const CodecParameters& parameters);

}  // namespace folprom
