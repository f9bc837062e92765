// Decoding from memory, one thread, layer by layer. Links the C++ standard library and xxHash only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "folprom/attribute.h"
#include "folprom/result.h"

namespace folprom {

/// A level of detail. Positions in model units. Those of the last layer of an exact file
/// (`encode --exact`) are the scan's own, bit for bit; where the scan had floats, NarrowToFloatBits
/// of folprom/float_bits.h gives back theirs, also of a NaN.
struct DecodedMesh {
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<uint64_t, 3>> faces;
  bool is_float = false;  ///< the scan had floats, or integers that fit into one
  /// Vertices and faces stand in the scan's order (encode --keep-order): the last layer is decoded,
  /// and the file is not cut behind it.
  bool has_scan_order = false;
  /// Where the scan had faces of more than three corners, and they are known: the first triangle of
  /// each of its faces. Those of a face are (a, b, c), (a, c, d), (a, d, e) ... Else empty.
  std::vector<uint64_t> polygon_begin = {};
  std::vector<DecodedAttribute> attributes = {};  ///< in the order of the scan
  /// Of the whole mesh alone, in the order of the scan.
  std::vector<DecodedFaceAttribute> face_attributes = {};
};

/// Decodes a .folp file held in memory. Not thread-safe; move-only.
class MemoryDecoder {
 public:
  /// `file` must outlive the decoder. `memory_bytes`: what the models of all subtrees may take,
  /// some 350 KiB each; 0: 56 MiB and 56 times the bytes given, more than the whole of a file needs
  /// whose subtrees have 10,000 vertices, but less than the first part of one of some 20 million.
  /// Errors: kCorrupt, kInput (unknown version), kLimit.
  static Result<MemoryDecoder> Open(std::span<const uint8_t> file, uint64_t memory_bytes = 0);
  MemoryDecoder(MemoryDecoder&&) noexcept;
  MemoryDecoder& operator=(MemoryDecoder&&) noexcept;
  ~MemoryDecoder();

  size_t layer_count() const;      ///< as announced
  size_t complete_layers() const;  ///< whole in the bytes given
  size_t decoded_layers() const;
  double error_bound() const;  ///< of the last decoded layer, model units
  /// Decodes one more layer, and with the last one what the file tells of the scan's order,
  /// polygons and attributes of faces. kCorrupt when it is damaged or cut; the mesh then stays that
  /// of the layers before only if nothing of the layer was applied, so stop using the decoder.
  Result<void> DecodeNextLayer();
  /// The mesh of the layers decoded so far (at least one). Of the last layer of a soup, such as STL
  /// files are, each face has three vertices of its own.
  DecodedMesh Mesh() const;

 private:
  struct Impl;
  explicit MemoryDecoder(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace folprom
