// What stands before the coded bits of a .folp file: settings, counts, layers, sizes, checksums.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/formats/face_schema.h"
#include "io/formats/vertex_schema.h"

namespace folprom::io {

inline constexpr uint32_t kFormatVersion = 1;  ///< written, and the newest that is read
inline constexpr size_t kMaxLayers = 4096;
inline constexpr uint64_t kMaxCount = (uint64_t{1} << 48) - 1;  ///< of vertices, and of faces
inline constexpr uint64_t kMaxSegmentBytes = 0xffffffffu;       ///< of one segment

/// Kinds of coded bits that `info` tells apart.
enum class BitKind : uint8_t {
  kSplit = 0,
  kOffsets,
  kRefinement,
  kConnectivity,
  kExceptions,
  kSeams
};
inline constexpr size_t kBitKinds = 6;

/// Order-free digest of the decoded mesh: sums of hashes over vertices and over faces (mod 2^64).
struct MeshDigest {
  uint64_t vertices = 0;
  uint64_t faces = 0;
  bool operator==(const MeshDigest&) const = default;
};

/// One layer over all subtrees. Layers 0 .. k together give one LOD.
struct LayerRecord {
  /// Model units; no original vertex lies further from its representative. The lower half of the
  /// float is 0.
  float error_bound = 0;
  uint64_t vertices = 0;  ///< of the LOD after this layer; never fewer than after the one before
  uint64_t faces = 0;     ///< of the LOD after this layer
  bool operator==(const LayerRecord&) const = default;
};

/// The least error bound that a table can hold and that is above `bound` (>= 0).
float NextErrorBound(double bound);

struct SubtreeRecord {
  uint32_t vertices = 0;            ///< of the original mesh, at least 1
  std::array<int32_t, 3> box_lo{};  ///< working lattice
  std::array<int32_t, 3> box_hi{};
  /// Subtrees of lower number that share a face with it, ascending.
  std::vector<uint32_t> lower_neighbours;
  bool operator==(const SubtreeRecord&) const = default;
};

/// A segment is named by (layer, subtree, part).
enum class SegmentPart : uint8_t { kInner = 0, kSeam = 1 };

/// What may follow the last layer, in this order: what the scan's file has beyond its triangles.
enum class SectionKind : uint8_t {
  kOrder = 0,  ///< of vertices and faces, and the corner that each face begins with
  kPolygons,   ///< which triangles are one face
  kFaceValues  ///< attributes of faces and of their corners
};
inline constexpr size_t kSectionKinds = 3;

struct SectionRecord {
  uint64_t bytes = 0;   ///< with the lengths and checksums of its blocks
  uint64_t digest = 0;  ///< of what it gives
  bool operator==(const SectionRecord&) const = default;
};

/// Everything in the tables of a file; of a cut one, in those that are there. Coded compactly; see
/// FORMAT.md.
struct FileTable {
  uint64_t vertices = 0;
  uint64_t faces = 0;
  uint8_t coordinate_type = 6;      ///< ScalarType of the output: 6 float32, 7 float64
  std::array<double, 3> origin{};   ///< lattice
  double unit = 1;                  ///< lattice
  std::array<int32_t, 3> extent{};  ///< lattice, 0 .. 2^30 - 1
  /// Each face has three vertices of its own in the scan; those of equal coordinates are one here.
  bool is_soup = false;
  std::vector<uint8_t> codec;  ///< settings of the coder, meaning known to the engine only
  /// Of the vertices; each has a range below, and bits in the last table.
  VertexSchema schema;
  std::vector<AttributeRange> attribute_ranges;
  /// Of the faces, and a range of each column; where there is a section of their values.
  FaceSchema face_schema;
  std::vector<AttributeRange> face_ranges;
  std::vector<std::string> remarks;  ///< lines of the scan's header: IsRemark
  // In the last table.
  double tolerance = 0;  ///< model units, per axis
  MeshDigest digest;
  std::array<uint64_t, kBitKinds> kind_bits{};  ///< bits spent per kind, whole file, rounded
  std::vector<uint64_t> attribute_bits;         ///< the same, per attribute
  /// Those that the file has are in its first table, and what they say in the last.
  std::array<std::optional<SectionRecord>, kSectionKinds> sections;
  uint64_t polygons = 0;      ///< faces of the scan, where there are sections; else 0
  uint64_t largest_face = 0;  ///< corners, where there are sections; else 0
  std::vector<LayerRecord> layers;
  std::vector<SubtreeRecord> subtrees;
  /// Size in bytes of each segment, index SegmentIndex(layer, subtree, part).
  std::vector<uint64_t> segment_bytes;

  size_t SegmentIndex(size_t layer, size_t subtree, SegmentPart part) const {
    return (layer * subtrees.size() + subtree) * 2 + static_cast<size_t>(part);
  }
  /// Has any subtree a lower neighbour; if not, there is no place for seam segments.
  bool HasSeams() const {
    return std::any_of(subtrees.begin(), subtrees.end(), [](const SubtreeRecord& subtree) {
      return !subtree.lower_neighbours.empty();
    });
  }
  const std::optional<SectionRecord>& Section(SectionKind kind) const {
    return sections[static_cast<size_t>(kind)];
  }
  bool HasSections() const {
    return std::any_of(sections.begin(), sections.end(),
                       [](const auto& section) { return section.has_value(); });
  }
  /// Vertices that the whole mesh has when it is written.
  uint64_t OutputVertices() const { return is_soup ? 3 * faces : vertices; }
  /// Has it anything that a scan of bare positions and faces has not.
  bool HasExtras() const {
    return !schema.attributes.empty() || !remarks.empty() || !face_schema.empty();
  }
  bool operator==(const FileTable&) const = default;
};

}  // namespace folprom::io
