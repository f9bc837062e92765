// Decodes the subtrees and seams of an opened container. Standard library and xxHash only.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/codec/parameters.h"
#include "engine/codec/seam_coder.h"
#include "engine/codec/subtree_coder.h"
#include "engine/entropy/bit_coder.h"
#include "engine/mesh/lattice.h"
#include "io/container/reader.h"

namespace folprom {

/// Settings and schedule of a file of so many layers. Throws Failure kCorrupt where they contradict
/// its table.
CodecParameters ParametersOf(const io::FileTable& table, size_t layers_total);
/// The lattice of the file; `parameters` are those of its table.
Lattice LatticeOf(const io::FileTable& table, const CodecParameters& parameters);
/// Does the subtree share a face with any other.
std::vector<bool> SubtreesWithBorder(const io::FileTable& table);

/// One subtree with its bit decoder; layers are read in order.
class SubtreeReader {
 public:
  SubtreeReader(const io::ContainerReader& container, const CodecParameters& parameters,
                size_t subtree, bool has_border);
  /// Throws Failure kCorrupt that names file, layer and subtree.
  void DecodeLayer();
  const SubtreeCoder& state() const { return coder_; }

 private:
  const io::ContainerReader& container_;
  size_t subtree_;
  SubtreeCoder coder_;
  BitDecoder bits_;
};

/// The seam of one subtree; the records of its members must reach the layer that is decoded.
class SeamReader {
 public:
  SeamReader(const io::ContainerReader& container, const CodecParameters& parameters, size_t owner,
             std::vector<SeamCoder::Participant> participants);
  void DecodeLayer();
  const SeamCoder& state() const { return coder_; }

 private:
  const io::ContainerReader& container_;
  size_t owner_;
  size_t layer_ = 0;
  SeamCoder coder_;
  BitDecoder bits_;
};

}  // namespace folprom
