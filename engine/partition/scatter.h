// Deals vertices and faces out to the subtrees, in the order of the file.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/partition/job.h"
#include "engine/partition/offset_file.h"
#include "io/files/mapped_file.h"
#include "io/spill/spill.h"

namespace folprom::partition {

/// A stream per subtree for each kind of value of a vertex.
struct VertexStreams {
  io::SpillStreams* positions = nullptr;   ///< Int3
  io::SpillStreams* exact = nullptr;       ///< ExactPosition; null: not kept
  io::SpillStreams* attributes = nullptr;  ///< as the source gives them; null: not kept
};

/// Appends each vertex's values to the streams of its subtree and writes a VertexRef per vertex.
/// `subtree_of_voxel` gives the subtree of each voxel that a VertexRecord names. Returns the range
/// of each attribute.
std::vector<io::AttributeRange> ScatterVertices(Job& job, const OffsetFile& records,
                                                std::span<const uint32_t> subtree_of_voxel,
                                                size_t subtree_count, OffsetFile& vertex_map,
                                                const VertexStreams& streams);

/// Appends each triangle as a Face to the stream of its subtree, or as a CrossFace to the stream of
/// each subtree that it touches. Fills in the face counts and neighbours of `subtrees`.
void ScatterFaces(Job& job, const io::MappedFile& records, const io::MappedFile& vertex_map,
                  io::SpillStreams& faces, io::SpillStreams& cross_faces,
                  std::span<SubtreeSummary> subtrees);

}  // namespace folprom::partition
